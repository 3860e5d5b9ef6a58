import { places } from "../../generated/wgsl";
import { looksBlock, Scene, sunMapSize } from "../frame";
import { bladeShadowTexels, unsettledTurn } from "../../generated/layout";
import { bladeWords } from "../../format/blades";
import { fail } from "../../format/error";
import { Field, pageBlades } from "../../format/field";
import { GroundImage } from "../../format/ground";
import { patchWords } from "../../format/patches";
import { subtreeWidths } from "../tree";

/** Visible blades of a frame at most. */
const maxVisible = 1 << 22;

// Of web/shaders/webgpu/listed_quads.glsl.
const maxQuads = 1 << 18;
const maxRowBlocks = 1 << 20;

/** Words of `counters` and of `arguments`: web/shaders/webgpu/scene.glsl. */
export const counterWords = 8;
export const argumentWords = 12;

export function makeBuffer(device: GPUDevice, label: string, size: number, usage: GPUBufferUsageFlags): GPUBuffer {
  const most = Math.min(device.limits.maxBufferSize, device.limits.maxStorageBufferBindingSize);
  if (size > most) fail("unsupported", `this device has room for ${most} bytes of ${label}, not for ${size}`);
  return device.createBuffer({ label, size: Math.max(Math.ceil(size / 16) * 16, 16), usage });
}

/** A buffer with these contents. */
export function filledBuffer(device: GPUDevice, label: string, data: ArrayBufferView, usage: GPUBufferUsageFlags): GPUBuffer {
  const buffer = makeBuffer(device, label, data.byteLength, usage | GPUBufferUsage.COPY_DST);
  const whole = data.byteLength - (data.byteLength % 4);
  device.queue.writeBuffer(buffer, 0, data.buffer, data.byteOffset, whole);
  return buffer;
}

/** A part of the ground with one material. */
export interface GroundPart {
  first: number;
  count: number;
  isDoubleSided: boolean;
  material: GPUBuffer;
  image: GPUTexture;
}

/** What lies on the device as long as a field is shown. */
export class FieldMemory {
  /** Buffers by the names of bindings. */
  readonly buffers: Record<string, GPUBuffer>;
  readonly sunMap: GPUTexture;
  readonly vertices: GPUBuffer;
  readonly indices: GPUBuffer;
  readonly parts: GroundPart[];
  /** Visible blades at most. */
  readonly capacity: number;
  private readonly uploaded: Uint8Array;
  private readonly present: Uint32Array<ArrayBuffer>;

  constructor(
    private readonly device: GPUDevice,
    private readonly field: Field,
    scene: Scene,
  ) {
    const { STORAGE, COPY_DST, COPY_SRC, UNIFORM, INDIRECT, VERTEX, INDEX } = GPUBufferUsage;
    const blades = Math.max(field.bladeCount, 1);
    const make = (label: string, size: number, usage = 0) => makeBuffer(device, label, size, STORAGE | COPY_DST | usage);
    this.capacity = Math.min(blades, maxVisible);
    this.uploaded = new Uint8Array(field.pageCount);
    this.present = new Uint32Array(Math.ceil(Math.max(field.pageCount, 1) / 32));
    const corners = scene.cover.corners;
    this.buffers = {
      looks: filledBuffer(device, "looks", new Uint8Array(looksBlock(field).bytes), UNIFORM),
      blades: make("blades", 4 * bladeWords * pageBlades * Math.max(field.pageCount, 1)),
      states: statesOf(device, blades),
      patches: filledBuffer(device, "patches", patchTable(field), STORAGE),
      widest: filledBuffer(device, "widths", subtreeWidths(field.patches), STORAGE),
      grass: filledBuffer(device, "cover", corners, STORAGE),
      patchTimes: make("patch times", 4 * field.patches.count),
      present: make("pages", this.present.byteLength),
      visiblePatches: make("visible patches", 8 * field.patches.count),
      visible: make("visible blades", 16 * this.capacity),
      counters: make("counters", 4 * counterWords, COPY_SRC),
      arguments: make("arguments", 4 * argumentWords, INDIRECT),
      quads: make("quads", 80 * maxQuads),
      rowBlocks: make("rows", 4 * maxRowBlocks),
      map: make("blade shadow", 8 * bladeShadowTexels * bladeShadowTexels),
    };
    this.sunMap = device.createTexture({
      label: "sun map",
      size: [sunMapSize, sunMapSize],
      format: "depth32float",
      usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING,
    });
    this.vertices = filledBuffer(device, "ground", field.ground.vertices, VERTEX);
    this.indices = filledBuffer(device, "triangles", field.ground.indices, INDEX);
    this.parts = this.groundParts();
  }

  private groundParts(): GroundPart[] {
    const { device, field } = this;
    const white = imageTexture(device, { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) });
    const images = field.ground.images.map((image) => imageTexture(device, image));
    return field.ground.ranges
      .filter((range) => range.level === 0 && range.indexCount > 0)
      .map((range) => {
        const material = field.ground.materials[range.material];
        const bytes = new ArrayBuffer(places.Material.size);
        new Float32Array(bytes).set(material.baseColor.slice(0, 3), places.Material.members.color / 4);
        new Uint32Array(bytes)[places.Material.members.isDoubleSided / 4] = material.isDoubleSided ? 1 : 0;
        return {
          first: range.firstIndex,
          count: range.indexCount,
          isDoubleSided: material.isDoubleSided,
          material: filledBuffer(device, "material", new Uint8Array(bytes), GPUBufferUsage.UNIFORM),
          image: images[material.image] ?? white,
        };
      });
  }

  /** Copies the pages that have come to the device. */
  uploadPages(): void {
    const { device, field } = this;
    if (field.presentPages === 0) return;
    const bytes = 4 * pageBlades * bladeWords;
    let hasChanged = false;
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      let end = page + 1;
      while (end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1)) ++end;
      const words = field.packed.subarray((page * bytes) / 4, (end * bytes) / 4);
      device.queue.writeBuffer(this.buffers.blades, page * bytes, words.buffer, words.byteOffset, words.byteLength);
      this.uploaded.fill(1, page, end);
      for (let p = page; p < end; ++p) this.present[p >> 5] |= 1 << (p & 31);
      hasChanged = true;
    }
    if (hasChanged) device.queue.writeBuffer(this.buffers.present, 0, this.present);
  }

  destroy(): void {
    for (const one of Object.values(this.buffers)) one.destroy();
    for (const one of [this.sunMap, this.vertices, this.indices]) one.destroy();
    for (const part of this.parts) {
      part.material.destroy();
      part.image.destroy();
    }
  }
}

/** States of blades that no view has shown yet. */
function statesOf(device: GPUDevice, blades: number): GPUBuffer {
  const { STORAGE, COPY_DST } = GPUBufferUsage;
  const buffer = makeBuffer(device, "states", 4 * blades, STORAGE | COPY_DST);
  const step = 1 << 20;
  const words = new Uint32Array(Math.min(step, blades)).fill(unsettledTurn);
  for (let first = 0; first < blades; first += step)
    device.queue.writeBuffer(buffer, 4 * first, words, 0, Math.min(step, blades - first));
  return buffer;
}

/** The patch tree with the stride that WGSL gives it. */
function patchTable(field: Field): Uint32Array {
  const stride = places.Patch.size / 4;
  const table = new Uint32Array(Math.max(field.patches.count, 1) * stride);
  for (let p = 0; p < field.patches.count; ++p)
    table.set(field.patches.words.subarray(p * patchWords, (p + 1) * patchWords), p * stride);
  return table;
}

const toLinear = Float32Array.from({ length: 256 }, (_, i) =>
  i / 255 <= 0.04045 ? i / 255 / 12.92 : ((i / 255 + 0.055) / 1.055) ** 2.4,
);
const steps = 4095;
const toBytes = Uint8Array.from({ length: steps + 1 }, (_, i) => {
  const x = i / steps;
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
});

/** An image of half the size, each texel the mean light of four. */
function halved({ width, height, pixels }: GroundImage): GroundImage {
  const [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
  const half = new Uint8Array(4 * w * h);
  for (let y = 0; y < h; ++y) {
    const [above, below] = [2 * y, Math.min(2 * y + 1, height - 1)].map((row) => row * width);
    for (let x = 0; x < w; ++x) {
      const [left, right] = [2 * x, Math.min(2 * x + 1, width - 1)];
      const four = [above + left, above + right, below + left, below + right];
      for (let c = 0; c < 4; ++c) {
        let sum = 0;
        for (const texel of four) sum += c < 3 ? toLinear[pixels[4 * texel + c]] : pixels[4 * texel + c];
        half[4 * (y * w + x) + c] = c < 3 ? toBytes[Math.round(0.25 * sum * steps)] : Math.round(0.25 * sum);
      }
    }
  }
  return { width: w, height: h, pixels: half };
}

/** An image of the ground with its levels. Levels larger than the device's largest texture are left out. */
function imageTexture(device: GPUDevice, image: GroundImage): GPUTexture {
  const most = device.limits.maxTextureDimension2D;
  let level = image;
  while (level.width > most || level.height > most) level = halved(level);
  const count = Math.floor(Math.log2(Math.max(level.width, level.height))) + 1;
  const texture = device.createTexture({
    label: "image of the ground",
    size: [level.width, level.height],
    mipLevelCount: count,
    format: "rgba8unorm-srgb",
    usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
  });
  for (let i = 0; i < count; ++i) {
    const pixels = new Uint8Array(level.pixels);
    const size = [level.width, level.height];
    device.queue.writeTexture({ texture, mipLevel: i }, pixels, { bytesPerRow: 4 * level.width }, size);
    level = halved(level);
  }
  return texture;
}
