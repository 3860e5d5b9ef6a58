import { SwardError } from "../../format/error";
import { Field } from "../../format/field";
import { viewOf } from "../camera";
import { Cover, noCover } from "../cover";
import { FrameInput, frameSettings, minWidthOf, Scene } from "../frame";
import { Light, turnedWith, usualLight } from "../light";
import { DrawInput, DrawStats, shadowDistance } from "../renderer";
import { sceneOf } from "../scene";
import { PatchTree } from "../tree";
import { scaled, unit } from "../vector";
import { openDevice } from "./device";
import { Counts, Passes, Pipelines, Timing } from "./passes";

/** Blades that are moved and posed in a frame at most, if a caller names no number. */
const usualMax = 4_000_000;

/** Draws a field by WebGPU, with the passes of the viewer. The shaders are the viewer's: see web/generate_wgsl.mjs. */
export class WebGpuRenderer {
  readonly kind = "webgpu";
  /** Fields that are sown are drawn by WebGL. */
  readonly sowing = undefined;
  readonly scene: Scene;
  private readonly tree: PatchTree;
  private lodThreshold = frameSettings.lodThreshold;
  private wasLost = false;
  private isStopped = false;

  private constructor(
    readonly canvas: HTMLCanvasElement | undefined,
    private readonly context: GPUCanvasContext | undefined,
    readonly device: GPUDevice,
    readonly field: Field,
    scene: Scene,
    private readonly passes: Passes,
  ) {
    this.scene = scene;
    this.tree = new PatchTree(field);
    void device.lost.then(() => {
      this.wasLost = true;
    });
  }

  /**
   * A renderer; undefined where there is no WebGPU. The canvas may have no other context. Without a canvas it draws
   * pictures for readPicture(). `acceptsSoftware`: also a device that is the processor.
   */
  static async make(
    canvas: HTMLCanvasElement | undefined,
    field: Field,
    cover: Cover = noCover,
    { device, acceptsSoftware = false }: { device?: GPUDevice; acceptsSoftware?: boolean } = {},
  ): Promise<WebGpuRenderer | undefined> {
    const own = device ?? (await openDevice({ acceptsSoftware }));
    if (!own) return undefined;
    const format = canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm";
    const scene = sceneOf(field, cover);
    try {
      const pipelines = await Pipelines.make(own, field, format);
      const passes = new Passes(own, field, scene, pipelines);
      const context = (canvas?.getContext("webgpu") ?? undefined) as GPUCanvasContext | undefined;
      if (canvas && !context) return undefined;
      context?.configure({ device: own, format, alphaMode: "opaque" });
      return new WebGpuRenderer(canvas, context, own, field, scene, passes);
    } catch (error) {
      // A field that is too large for this device, or a compiler that does not take a shader: WebGL may draw it.
      if (!(error instanceof SwardError)) console.warn(error);
      if (!device) own.destroy();
      return undefined;
    }
  }

  /** The sun as the viewer has it by default. */
  get usualLight(): Light {
    const up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }

  get isLost(): boolean {
    return this.wasLost;
  }

  /** Calls back when the device is lost, unless stop() ended it. */
  onLost(act: () => void): void {
    void this.device.lost.then(() => {
      if (!this.isStopped) act();
    });
  }

  /** Frees all that lies on the device. */
  stop(): void {
    this.isStopped = true;
    this.passes.destroy();
    this.context?.unconfigure();
    this.device.destroy();
  }

  /** Draws a picture as large as the canvas. `isFine` changes nothing: all pictures have four samples a pixel. */
  draw(input: DrawInput): DrawStats {
    const { width, height } = this.canvas!;
    return this.drawInto(input, this.context!.getCurrentTexture().createView(), width, height);
  }

  /** Whether samples are written by atomics of 64 bits; else by two passes of 32 bits. */
  get has64(): boolean {
    return this.passes.pipelines.has64;
  }

  /** What a frame that has ended drew. */
  get counts(): Counts {
    return this.passes.counts;
  }

  /** Draws into a texture. `timing`: where passes note when they begin and end. */
  drawInto(input: DrawInput, target: GPUTextureView, width: number, height: number, timing?: Timing): DrawStats {
    const { field, scene, passes } = this;
    const view = viewOf(input.camera, field.origin, width, height, scene.content);
    this.adapt(input.maxBlades ?? usualMax);
    const frame: FrameInput = {
      view,
      camera: input.camera,
      light: input.light ?? this.usualLight,
      wind: input.wind ?? 1,
      time: input.time,
      shadowDistance,
      lodThreshold: this.lodThreshold,
      sparseFrom: 0,
      sparseLeast: 1,
    };
    passes.draw(frame, target, width, height, timing);
    let missing: number[] = [];
    if (!field.isComplete)
      missing = this.tree.groupsOf(
        {
          eye: view.eye,
          planes: view.planes,
          drawDistance: field.defaults.drawDistance,
          pixelsPerUnit: view.pixelsPerUnit,
          lodThreshold: this.lodThreshold,
          lodWidth: scene.bladeWidth,
          minWidth: minWidthOf(view),
          sparseFrom: 0,
          sparseLeast: 1,
        },
        Infinity,
      ).missing;
    return { blades: passes.counts.moved, missing };
  }

  /** Level of detail follows the number of blades that the frames before had. */
  private adapt(most: number): void {
    const { moved } = this.passes.counts;
    const usual = frameSettings.lodThreshold;
    const ratio = Math.sqrt(moved / most);
    if (ratio > 1.15) this.lodThreshold *= Math.min(ratio, 2);
    else if (ratio > 1) this.lodThreshold *= 1.02;
    else if (ratio < 0.9) this.lodThreshold = Math.max(this.lodThreshold / 1.05, usual);
  }

  /** Draws a picture and returns it: rows from the top, four bytes a pixel, sRGB. */
  async readPicture(input: DrawInput, width: number, height: number, timing?: Timing): Promise<Uint8ClampedArray> {
    const { device } = this;
    const format = this.canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm";
    const { RENDER_ATTACHMENT, COPY_SRC } = GPUTextureUsage;
    const texture = device.createTexture({ size: [width, height], format, usage: RENDER_ATTACHMENT | COPY_SRC });
    this.drawInto(input, texture.createView(), width, height, timing);
    const bytesPerRow = 256 * Math.ceil((4 * width) / 256);
    const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer: read, bytesPerRow }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    const rows = new Uint8Array(read.getMappedRange());
    const pixels = new Uint8ClampedArray(4 * width * height);
    for (let y = 0; y < height; ++y) pixels.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + 4 * width), 4 * width * y);
    if (format === "bgra8unorm")
      for (let i = 0; i < pixels.length; i += 4) [pixels[i], pixels[i + 2]] = [pixels[i + 2], pixels[i]];
    read.destroy();
    texture.destroy();
    return pixels;
  }

  /** Curves of the blades that the last picture drew, 12 words each; for tests. */
  readRecords(): Promise<Uint32Array> {
    return this.passes.readRecords();
  }
}
