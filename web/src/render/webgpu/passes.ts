import { bladeShadowTexels, cullDistance, cullFrustum, frameBytes, leaveThinned } from "../../generated/layout";
import { places } from "../../generated/wgsl";
import { Field } from "../../format/field";
import { groundVertexBytes } from "../../format/ground";
import { Block } from "../block";
import { frameBlock, FrameInput, Scene, shadowPlanes, shadowRows } from "../frame";
import { hasAtomic64, overridesOf } from "./device";
import { counterWords, FieldMemory, makeBuffer } from "./memory";
import { computeStage, DrawingStage, drawingStage, Stage, StageName } from "./stages";

/** Ticks of the wind in a second: ticksPerSecond of shaders/shared/update_rate.h. */
const ticksPerSecond = 262144;
const samples = 4;
const pushBytes = places.Push.size;
const argumentsPatches = 0;
const argumentsBlades = 16;
const argumentsRows = 32;
/** Value of the first visible blade in a visibility. */
const firstBlade = 1;

/** Where passes note when they begin and end, for measurements. */
export interface Timing {
  set: GPUQuerySet;
  names: string[];
}

/** Levels of a pyramid of depths: shaders/shared/occlusion.h. */
interface Level {
  first: number;
  cells: number;
}

function pyramidLevels(width: number, height: number): Level[] {
  const levels: Level[] = [];
  let first = 0;
  for (let bits = 2; levels.length < 7; bits += 2) {
    const [x, y] = [width, height].map((pixels) => Math.max(Math.ceil(pixels / 2 ** bits), 1));
    levels.push({ first, cells: x * y });
    first += x * y;
    if (x === 1 && y === 1) break;
  }
  return levels;
}

/** Bits of the nearest depth. */
const nearestBits = 0x3f800000;

/** What depends on the size of the picture. */
class Picture {
  readonly depth: GPUTexture;
  readonly light: GPUTexture;
  readonly resolved: GPUTexture;
  readonly visibility: GPUBuffer;
  readonly levels: Level[];
  readonly cells: GPUBuffer;
  /** What the pyramid begins with. */
  private readonly nearest: Uint32Array<ArrayBuffer>;

  constructor(
    private readonly device: GPUDevice,
    readonly width: number,
    readonly height: number,
  ) {
    const { RENDER_ATTACHMENT, TEXTURE_BINDING, STORAGE_BINDING } = GPUTextureUsage;
    const make = (label: string, format: GPUTextureFormat, sampleCount: number, usage: number) =>
      device.createTexture({ label, size: [width, height], format, sampleCount, usage });
    this.visibility = makeBuffer(device, "visibility", 8 * samples * width * (4 * Math.ceil(height / 4)), GPUBufferUsage.STORAGE);
    this.levels = pyramidLevels(width, height);
    const last = this.levels[this.levels.length - 1];
    this.nearest = new Uint32Array(last.first + last.cells).fill(nearestBits);
    this.cells = makeBuffer(device, "pyramid", this.nearest.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    this.depth = make("depth", "depth32float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING);
    this.light = make("light of the ground", "rgba16float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING);
    this.resolved = make("picture", "rgba16float", 1, STORAGE_BINDING | TEXTURE_BINDING);
  }

  /** Levels beyond the first are made by minima. */
  beginPyramid(): void {
    this.device.queue.writeBuffer(this.cells, 0, this.nearest);
  }

  destroy(): void {
    for (const one of [this.cells, this.depth, this.light, this.resolved, this.visibility]) one.destroy();
  }
}

const computeNames = ["walk", "arguments", "update", "seed", "resolve", "records"] as const;
const rasterNames = ["raster", "rasterQuads", "shadow"] as const;
type ComputeName = (typeof computeNames)[number] | (typeof rasterNames)[number];

/** The pipelines of a field. */
export class Pipelines {
  private constructor(
    readonly compute: Record<ComputeName, Stage>,
    /** Whether samples are written by atomics of 64 bits. */
    readonly has64: boolean,
    readonly groundDepth: DrawingStage[],
    readonly ground: DrawingStage[],
    readonly sun: DrawingStage,
    readonly film: DrawingStage,
  ) {}

  /** Compiles all of them side by side. `format`: of the texture that the film is drawn into. */
  static async make(device: GPUDevice, field: Field, format: GPUTextureFormat): Promise<Pipelines> {
    const overrides = overridesOf(field);
    const stage = (name: StageName) => computeStage(device, name, overrides);
    const position: GPUVertexAttribute = { shaderLocation: 0, offset: 0, format: "float32x3" };
    const layout = (attributes: GPUVertexAttribute[]): GPUVertexBufferLayout[] => [{ arrayStride: groundVertexBytes, attributes }];
    const all = layout([
      position,
      { shaderLocation: 1, offset: 12, format: "uint32" },
      { shaderLocation: 2, offset: 16, format: "float32x2" },
      { shaderLocation: 3, offset: 24, format: "unorm8x4" },
    ]);
    const depthOf = (depthCompare: GPUCompareFunction, depthWriteEnabled: boolean): GPUDepthStencilState => ({
      format: "depth32float",
      depthCompare,
      depthWriteEnabled,
    });
    const sides: GPUCullMode[] = ["back", "none"];
    const [plain, raster, groundDepth, ground, sun, film] = await Promise.all([
      Promise.all(computeNames.map(stage)),
      rasterStages(device, stage),
      Promise.all(
        sides.map((cullMode) =>
          drawingStage(device, "groundVertex", null, {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("greater", true),
          }),
        ),
      ),
      Promise.all(
        sides.map((cullMode) =>
          drawingStage(device, "groundVertex", "groundFragment", {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("equal", false),
            targets: [{ format: "rgba16float" }],
          }),
        ),
      ),
      drawingStage(device, "sunVertex", null, { vertex: layout([position]), depthStencil: depthOf("greater", true) }),
      drawingStage(device, "filmVertex", "filmFragment", { targets: [{ format }] }),
    ]);
    const compute = Object.fromEntries([
      ...computeNames.map((name, i) => [name, plain[i]]),
      ...rasterNames.map((name, i) => [name, raster.stages[i]]),
    ]) as Record<ComputeName, Stage>;
    return new Pipelines(compute, raster.has64, groundDepth, ground, sun, film);
  }
}

/** Stages that write samples, by atomics of 64 bits where the device has them. */
async function rasterStages(
  device: GPUDevice,
  stage: (name: StageName) => Promise<Stage>,
): Promise<{ stages: Stage[]; has64: boolean }> {
  if (hasAtomic64(device)) {
    try {
      return { stages: await Promise.all(rasterNames.map((name) => stage(`${name}64`))), has64: true };
    } catch {
      // The device offers them, but its compiler does not take them.
    }
  }
  return { stages: await Promise.all(rasterNames.map(stage)), has64: false };
}

/** What a frame drew. */
export interface Counts {
  /** Blades that were drawn. */
  blades: number;
  /** Quads that were listed as large, and their blocks of eight rows. */
  quads: number;
  rows: number;
  /** Blades that were moved and culled. */
  moved: number;
}

/** The passes of a frame. */
export class Passes {
  private picture: Picture | undefined;
  private readonly memory: FieldMemory;
  private readonly frames: { eye: GPUBuffer; sun: GPUBuffer };
  private readonly pushes: Record<"eye" | "eyeIds" | "sun" | "sunIds", GPUBuffer>;
  private readonly sampler: GPUSampler;
  private groups = new Map<string, GPUBindGroup>();
  private sunOf = "";
  private readonly staging: GPUBuffer[] = [];
  /** Of a frame that has ended. */
  counts: Counts = { blades: 0, quads: 0, rows: 0, moved: 0 };

  constructor(
    readonly device: GPUDevice,
    private readonly field: Field,
    private readonly scene: Scene,
    readonly pipelines: Pipelines,
  ) {
    this.memory = new FieldMemory(device, field, scene);
    const uniform = (label: string, size: number) =>
      makeBuffer(device, label, size, GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST);
    this.frames = { eye: uniform("frame", frameBytes), sun: uniform("frame of the sun", frameBytes) };
    this.pushes = {
      eye: uniform("push", pushBytes),
      eyeIds: uniform("push", pushBytes),
      sun: uniform("push", pushBytes),
      sunIds: uniform("push", pushBytes),
    };
    this.sampler = device.createSampler({
      addressModeU: "repeat",
      addressModeV: "repeat",
      magFilter: "linear",
      minFilter: "linear",
      mipmapFilter: "linear",
    });
  }

  destroy(): void {
    this.picture?.destroy();
    this.memory.destroy();
  }

  /** The bind group of a stage. `view`: whose frame and push it has; `ids`: that of the pass of ids. */
  private group(stage: Stage | DrawingStage, view: "eye" | "sun", ids = false, target?: string): GPUBindGroup {
    const key = `${stage.pipeline.label} ${view} ${ids} ${target ?? ""}`;
    const known = this.groups.get(key);
    if (known) return known;
    const picture = this.picture!;
    const { buffers, sunMap } = this.memory;
    const textures: Record<string, GPUTexture> = {
      sunMap, groundDepth: picture.depth, groundLight: picture.light, resolved: picture.resolved, resolvedPicture: picture.resolved,
    };
    const resource = (name: string): GPUBindingResource => {
      if (name === "frameConstants") return { buffer: this.frames[view] };
      if (name === "push") return { buffer: this.pushes[ids ? (`${view}Ids` as const) : view] };
      if (name === "seenSamples") return { buffer: target === "map" ? buffers.map : picture.visibility };
      if (name === "cellBits") return { buffer: picture.cells };
      return textures[name]?.createView() ?? { buffer: buffers[name] };
    };
    const made = this.device.createBindGroup({
      label: key,
      layout: stage.pipeline.getBindGroupLayout(0),
      entries: Object.entries(stage.bindings).map(([name, binding]) => ({ binding, resource: resource(name) })),
    });
    this.groups.set(key, made);
    return made;
  }

  /** Draws a frame into `target`. `time`: of the wind [s]. */
  draw(input: FrameInput, target: GPUTextureView, width: number, height: number, timing?: Timing): void {
    const { device, memory, pipelines } = this;
    if (this.picture?.width !== width || this.picture.height !== height) {
      this.picture?.destroy();
      this.picture = new Picture(device, width, height);
      this.groups.clear();
    }
    memory.uploadPages();
    this.picture.beginPyramid();
    this.writeFrames(input, width, height);
    const encoder = device.createCommandEncoder();
    this.drawSunMap(encoder, input);
    const { buffers } = memory;
    const timed = timerOf(timing);
    const compute = (name: string, act: (pass: GPUComputePassEncoder) => void) => {
      const pass = encoder.beginComputePass({ label: name, timestampWrites: timed(name) });
      act(pass);
      pass.end();
    };
    const run = (pass: GPUComputePassEncoder, name: ComputeName, view: "eye" | "sun", ids = false, map?: string) => {
      const stage = pipelines.compute[name];
      pass.setPipeline(stage.pipeline);
      pass.setBindGroup(0, this.group(stage, view, ids, map));
    };
    const walk = (pass: GPUComputePassEncoder, view: "eye" | "sun") => {
      const groups = Math.ceil(this.field.patches.count / 64);
      if (groups === 0) return;
      run(pass, "walk", view);
      pass.dispatchWorkgroups(Math.min(groups, 4096), Math.ceil(groups / 4096));
      run(pass, "arguments", view);
      pass.dispatchWorkgroups(1);
    };
    const passesOfSamples = pipelines.has64 ? [false] : [false, true];

    this.drawGround(encoder, "ground depth", true, timed);
    encoder.clearBuffer(buffers.counters);
    compute("seed", (pass) => {
      run(pass, "seed", "eye");
      pass.dispatchWorkgroups(Math.ceil(width / 16), Math.ceil(height / 16));
    });
    compute("walk", (pass) => walk(pass, "eye"));
    compute("update", (pass) => {
      run(pass, "update", "eye");
      pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches);
      run(pass, "arguments", "eye");
      pass.dispatchWorkgroups(1);
    });
    for (const ids of passesOfSamples) {
      compute(ids ? "blades, ids" : "blades", (pass) => {
        run(pass, "raster", "eye", ids);
        pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsBlades);
        if (ids) return;
        run(pass, "arguments", "eye");
        pass.dispatchWorkgroups(1);
      });
      compute(ids ? "large, ids" : "large", (pass) => {
        run(pass, "rasterQuads", "eye", ids);
        pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsRows);
      });
    }
    if (input.shadowDistance > 0 && input.light.sunColor[0] > 0) {
      encoder.clearBuffer(buffers.counters, 0, 4);
      encoder.clearBuffer(buffers.map);
      compute("shadow", (pass) => {
        walk(pass, "sun");
        for (const ids of passesOfSamples) {
          run(pass, "shadow", "sun", ids, "map");
          pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches);
        }
      });
    } else encoder.clearBuffer(buffers.map);
    this.drawGround(encoder, "ground light", false, timed);
    compute("resolve", (pass) => {
      run(pass, "resolve", "eye");
      pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    });
    const film = encoder.beginRenderPass({
      label: "film",
      colorAttachments: [{ view: target, loadOp: "clear", storeOp: "store" }],
      timestampWrites: timed("film"),
    });
    film.setPipeline(pipelines.film.pipeline);
    film.setBindGroup(0, this.group(pipelines.film, "eye"));
    film.draw(3);
    film.end();
    const read = this.staging.pop() ?? device.createBuffer({ label: "counts", size: 4 * counterWords, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    encoder.copyBufferToBuffer(buffers.counters, 0, read, 0, 4 * counterWords);
    device.queue.submit([encoder.finish()]);
    void this.readCounts(read);
  }

  private async readCounts(read: GPUBuffer): Promise<void> {
    try {
      await read.mapAsync(GPUMapMode.READ);
    } catch {
      return;
    }
    const [, blades, quads, rows, moved] = new Uint32Array(read.getMappedRange());
    this.counts = { blades, quads, rows, moved };
    read.unmap();
    this.staging.push(read);
  }

  private writeFrames(input: FrameInput, width: number, height: number): void {
    const { device, scene } = this;
    const eye = frameBlock(scene, input);
    const depthOfEye = [2, 6, 10, 14].reduce(
      (sum, at, i) => sum + input.view.viewProjection[at] * (i < 3 ? input.view.eye[i] : 1),
      0,
    );
    eye.floats("depthOfEye", [depthOfEye]);
    device.queue.writeBuffer(this.frames.eye, 0, eye.bytes);
    const push = (buffer: GPUBuffer, size: readonly number[], isIdPass: boolean) => {
      const block = new Block(places.Push.members, pushBytes);
      block.words("size", size);
      block.words("patchCount", [this.field.patches.count]);
      block.words("tick", [Math.round((input.time % 16384) * ticksPerSecond)]);
      block.words("isIdPass", [isIdPass ? 1 : 0]);
      block.words("firstBlade", [firstBlade]);
      block.words("capacity", [this.memory.capacity]);
      if (buffer === this.pushes.eye) {
        const { levels } = this.picture!;
        block.words("pyramid.size", size);
        block.words("pyramid.levels", [levels.length]);
        levels.forEach((level, i) => block.words(`pyramid.first[${i}]`, [level.first]));
      }
      device.queue.writeBuffer(buffer, 0, block.bytes);
    };
    push(this.pushes.eye, [width, height], false);
    push(this.pushes.eyeIds, [width, height], true);
    if (!(input.shadowDistance > 0)) return;
    // The same frame as the sun sees it: blades have the widths that the eye's level of detail gives them.
    const rows = shadowRows(input.view, input.camera, input.light.sunDirection, input.shadowDistance);
    const sun = frameBlock(scene, input);
    shadowPlanes(rows).forEach((plane, i) => sun.floats(`view.planes[${i}]`, plane));
    sun.floats("view.minWidth", [0]);
    sun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned | 1]);
    sun.floats("viewProjection", [0, 1, 2, 3].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], k === 3 ? 1 : 0]));
    device.queue.writeBuffer(this.frames.sun, 0, sun.bytes);
    push(this.pushes.sun, [bladeShadowTexels, bladeShadowTexels], false);
    push(this.pushes.sunIds, [bladeShadowTexels, bladeShadowTexels], true);
  }

  /** The ground as the sun sees it, when the sun has moved. */
  private drawSunMap(encoder: GPUCommandEncoder, input: FrameInput): void {
    const key = input.light.sunDirection.join();
    if (this.sunOf === key) return;
    this.sunOf = key;
    const { memory, pipelines } = this;
    const pass = encoder.beginRenderPass({
      label: "sun map",
      colorAttachments: [],
      depthStencilAttachment: {
        view: memory.sunMap.createView(), depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "store",
      },
    });
    pass.setPipeline(pipelines.sun.pipeline);
    pass.setBindGroup(0, this.group(pipelines.sun, "eye"));
    pass.setVertexBuffer(0, memory.vertices);
    pass.setIndexBuffer(memory.indices, "uint32");
    for (const part of memory.parts) pass.drawIndexed(part.count, 1, part.first);
    pass.end();
  }

  /** Depths of the ground, or its light where samples show it. */
  private drawGround(
    encoder: GPUCommandEncoder,
    label: string,
    isDepth: boolean,
    timed: (name: string) => GPURenderPassTimestampWrites | undefined,
  ): void {
    const { memory, pipelines } = this;
    const picture = this.picture!;
    const pass = encoder.beginRenderPass({
      label,
      colorAttachments: isDepth
        ? []
        : [{ view: picture.light.createView(), clearValue: [0, 0, 0, 0], loadOp: "clear", storeOp: "store" }],
      depthStencilAttachment: isDepth
        ? { view: picture.depth.createView(), depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "store" }
        : { view: picture.depth.createView(), depthReadOnly: true },
      timestampWrites: timed(label),
    });
    pass.setVertexBuffer(0, memory.vertices);
    pass.setIndexBuffer(memory.indices, "uint32");
    memory.parts.forEach((part, i) => {
      const stage = (isDepth ? pipelines.groundDepth : pipelines.ground)[part.isDoubleSided ? 1 : 0];
      pass.setPipeline(stage.pipeline);
      pass.setBindGroup(0, this.group(stage, "eye", false, `${label} ${part.isDoubleSided}`));
      if (!isDepth) pass.setBindGroup(1, this.materialGroup(stage, i));
      pass.drawIndexed(part.count, 1, part.first);
    });
    pass.end();
  }

  private materialGroup(stage: DrawingStage, i: number): GPUBindGroup {
    const key = `material ${i}`;
    const known = this.groups.get(key);
    if (known) return known;
    const part = this.memory.parts[i];
    const made = this.device.createBindGroup({
      label: key,
      layout: stage.pipeline.getBindGroupLayout(1),
      entries: [
        { binding: 0, resource: { buffer: part.material } },
        { binding: 1, resource: part.image.createView() },
        { binding: 2, resource: this.sampler },
      ],
    });
    this.groups.set(key, made);
    return made;
  }

  /** Curves of the blades that the last frame drew, for tests: 12 words each (web/shaders/webgpu/records.comp). */
  async readRecords(): Promise<Uint32Array> {
    const { device, memory, pipelines } = this;
    const size = 48 * memory.capacity;
    const { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
    const records = makeBuffer(device, "records", size, STORAGE | COPY_SRC);
    memory.buffers.records = records;
    const read = device.createBuffer({ size: records.size + 4 * counterWords, usage: MAP_READ | COPY_DST });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipelines.compute.records.pipeline);
    pass.setBindGroup(0, this.group(pipelines.compute.records, "eye"));
    pass.dispatchWorkgroups(Math.min(Math.ceil(memory.capacity / 64), 4096), Math.ceil(memory.capacity / 64 / 4096));
    pass.end();
    encoder.copyBufferToBuffer(records, 0, read, 0, records.size);
    encoder.copyBufferToBuffer(memory.buffers.counters, 0, read, records.size, 4 * counterWords);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(read.getMappedRange()).slice();
    read.destroy();
    records.destroy();
    delete memory.buffers.records;
    this.groups.clear();
    return words.subarray(0, 12 * Math.min(words[records.size / 4 + 1], memory.capacity));
  }
}

/** Gives each pass its places in the query set. */
function timerOf(timing: Timing | undefined): (name: string) => GPURenderPassTimestampWrites | undefined {
  if (!timing) return () => undefined;
  timing.names.length = 0;
  return (name) => {
    const at = 2 * timing.names.length;
    timing.names.push(name);
    return { querySet: timing.set, beginningOfPassWriteIndex: at, endOfPassWriteIndex: at + 1 };
  };
}
