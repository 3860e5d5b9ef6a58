import { fail } from "../format/error";
import { expectOption } from "../format/options";
import { Field } from "../format/field";
import type { Sowing } from "../sow/sowing";
import { Cover } from "./cover";
import { Renderer } from "./renderer";
import { WebGpuRenderer } from "./webgpu/renderer";

/** What draws a field. */
export type RendererKind = "webgpu" | "webgl";

export const rendererKinds = '"webgpu" or "webgl"';
export const isRendererKind = (kind: unknown): boolean => kind === "webgpu" || kind === "webgl";

export type AnyRenderer = (Renderer | WebGpuRenderer) & { readonly canvas: HTMLCanvasElement };

/**
 * A renderer of a kind; without one WebGPU where a graphics card offers it, else WebGL 2. A field that is sown is drawn by
 * WebGL. The canvas may have no context before.
 */
export async function makeRenderer(
  canvas: HTMLCanvasElement,
  field: Field,
  cover: Cover,
  kind?: RendererKind,
  sowing?: Sowing,
): Promise<AnyRenderer> {
  expectOption("makeRenderer: kind", kind, rendererKinds, kind === undefined || isRendererKind(kind));
  if (sowing && kind === "webgpu")
    fail("usage", `${field.name}: a field that is sown is drawn by WebGL; sow: false shows its stored blades by WebGPU`);
  if (kind !== "webgl" && !sowing) {
    const own = await WebGpuRenderer.make(canvas, field, cover, { acceptsSoftware: kind === "webgpu" });
    if (own) return own as AnyRenderer;
    if (kind === "webgpu") fail("unsupported", "this browser has no WebGPU for this field, or its graphics driver is blocked");
  }
  return new Renderer(canvas, field, cover, sowing);
}
