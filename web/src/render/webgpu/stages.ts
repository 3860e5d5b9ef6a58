import { pieces, stages } from "../../generated/wgsl";

export type StageName = keyof typeof stages;

/** WGSL of a stage. */
export const textOf = (name: StageName): string =>
  stages[name].head + stages[name].pieces.map((i) => pieces[i]).join("\n");

/** Bindings of group 0 by their names. */
export const bindingsOf = (name: StageName): Record<string, number> => stages[name].resources;

/** A compute pipeline with the bindings that it has. */
export interface Stage {
  pipeline: GPUComputePipeline;
  bindings: Record<string, number>;
}

/** Values of constants that a pipeline gives, by their names. */
export type Overrides = Record<string, number>;

/** Those that a stage has. */
function ownOverrides(text: string, overrides: Overrides): Overrides {
  return Object.fromEntries(Object.entries(overrides).filter(([name]) => text.includes(`override ${name} `)));
}

export async function computeStage(device: GPUDevice, name: StageName, overrides: Overrides): Promise<Stage> {
  const code = textOf(name);
  const module = device.createShaderModule({ label: name, code });
  const pipeline = await device.createComputePipelineAsync({
    label: name,
    layout: "auto",
    compute: { module, entryPoint: "main", constants: ownOverrides(code, overrides) },
  });
  return { pipeline, bindings: bindingsOf(name) };
}

/** What a pipeline that draws has beside its stages. */
export type DrawingState = Omit<GPURenderPipelineDescriptor, "layout" | "vertex" | "fragment"> & {
  vertex?: GPUVertexBufferLayout[];
  targets?: GPUColorTargetState[];
};

export interface DrawingStage {
  pipeline: GPURenderPipeline;
  bindings: Record<string, number>;
}

export async function drawingStage(
  device: GPUDevice,
  vertex: StageName,
  fragment: StageName | null,
  state: DrawingState,
): Promise<DrawingStage> {
  const { vertex: buffers, targets, ...rest } = state;
  const module = (name: StageName) => device.createShaderModule({ label: name, code: textOf(name) });
  const pipeline = await device.createRenderPipelineAsync({
    label: fragment ?? vertex,
    layout: "auto",
    vertex: { module: module(vertex), entryPoint: "main", buffers: buffers ?? [] },
    ...(fragment ? { fragment: { module: module(fragment), entryPoint: "main", targets: targets ?? [] } } : {}),
    ...rest,
  });
  return { pipeline, bindings: { ...bindingsOf(vertex), ...(fragment ? bindingsOf(fragment) : {}) } };
}
