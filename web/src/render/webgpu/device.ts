import { shapeCount } from "../../generated/layout";
import { Field } from "../../format/field";
import { Overrides } from "./stages";

/** Atomics of 64 bits, which write depth and blade of a sample at once. */
const atomic64 = "atomic-vec2u-min-max" as GPUFeatureName;

/**
 * A device of WebGPU with the limits of its adapter; undefined where there is none. `acceptsSoftware`: also one that is
 * the processor, which draws WebGL faster. `only32`: without atomics of 64 bits.
 */
export async function openDevice({
  gpu = globalThis.navigator?.gpu,
  acceptsSoftware = false,
  only32 = false,
}: { gpu?: GPU; acceptsSoftware?: boolean; only32?: boolean } = {}): Promise<GPUDevice | undefined> {
  const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter || (adapter.info?.isFallbackAdapter && !acceptsSoftware)) return undefined;
  const { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits;
  const features = [...(only32 ? [] : [atomic64]), "timestamp-query" as const].filter((one) => adapter.features.has(one));
  return adapter
    .requestDevice({ requiredFeatures: features, requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } })
    .catch(() => undefined);
}

export const hasAtomic64 = (device: GPUDevice): boolean => device.features.has(atomic64);

/** What the shaders may know of a field's blades: fieldLooks() in src/render/field/field_looks.cpp. */
export function overridesOf(field: Field): Overrides {
  const looks = field.species.flatMap((one) => [one, ...one.organs]);
  const shapes = new Set(looks.map((one) => one.shape));
  return {
    mayFold: looks.some((one) => one.fold > 0) ? 1 : 0,
    mayHaveOrgans: field.species.some((one) => one.organs.length > 0) ? 1 : 0,
    onlyShape: shapes.size === 1 ? looks[0].shape : shapeCount,
  };
}
