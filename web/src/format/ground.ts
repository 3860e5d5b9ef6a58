import { Container } from "./container";
import { fail } from "./error";

/** An image of the ground: sRGB with alpha, rows from the top. */
export interface GroundImage {
  width: number;
  height: number;
  pixels: Uint8Array;
}

/** Triangles of one level and material. */
export interface GroundRange {
  level: number;
  material: number;
  firstIndex: number;
  indexCount: number;
}

/** A material of the ground. */
export interface GroundMaterial {
  baseColor: [number, number, number, number];
  roughness: number;
  metallic: number;
  /** Index of the base colour image; −1: none. */
  image: number;
  isDoubleSided: boolean;
}

/** The ground that is drawn below the blades. */
export interface Ground {
  /** 28 bytes a vertex: position, packed normal, uv, colour (docs/field_format.md). */
  vertices: Uint8Array;
  vertexCount: number;
  indices: Uint32Array;
  ranges: GroundRange[];
  materials: GroundMaterial[];
  images: GroundImage[];
}

/** Bytes of a vertex. */
export const groundVertexBytes = 28;

const largestSide = 16384;
const noImage = 0xffffffff;

async function bytesOf(container: Container, name: string): Promise<Uint8Array> {
  const chunk = container.find(name);
  return chunk ? container.bytes(chunk) : new Uint8Array(0);
}

function imagesOf(bytes: Uint8Array, place: string): GroundImage[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const images: GroundImage[] = [];
  for (let at = 0; at < bytes.length; ) {
    if (bytes.length - at < 8) fail("input", `${place}: image ${images.length} has no size`);
    const width = view.getUint32(at, true);
    const height = view.getUint32(at + 4, true);
    at += 8;
    if (width === 0 || height === 0 || width > largestSide || height > largestSide)
      fail("input", `${place}: image ${images.length} is ${width}×${height}, outside 1 to ${largestSide}`);
    const size = 4 * width * height;
    if (size > bytes.length - at)
      fail("input", `${place}: image ${images.length} needs ${size} bytes, ${bytes.length - at} are left`);
    images.push({ width, height, pixels: bytes.subarray(at, at + size) });
    at += size;
  }
  return images;
}

function verify(ground: Ground, place: string): void {
  const { vertices, vertexCount, indices } = ground;
  const floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < vertexCount; ++v)
    for (const word of [0, 1, 2, 4, 5])
      if (!Number.isFinite(floats[7 * v + word]))
        fail("input", `${place}: ground vertex ${v} is not finite`);
  for (const index of indices)
    if (index >= vertexCount)
      fail("input", `${place}: ground index ${index} has no vertex; there are ${vertexCount}`);
  for (const range of ground.ranges) {
    if (range.material >= ground.materials.length)
      fail("input", `${place}: ground material ${range.material} is missing; there are ${ground.materials.length}`);
    if (range.indexCount % 3 !== 0 || range.firstIndex + range.indexCount > indices.length)
      fail(
        "input",
        `${place}: a ground range of ${range.indexCount} indices from ${range.firstIndex} ` +
          `does not fit into ${indices.length}`,
      );
  }
  for (const material of ground.materials) {
    if (material.image >= ground.images.length)
      fail("input", `${place}: ground image ${material.image} is missing; there are ${ground.images.length}`);
    const isUnit = (x: number) => x >= 0 && x <= 1;
    if (!material.baseColor.every(Number.isFinite) || !isUnit(material.roughness) || !isUnit(material.metallic))
      fail("input", `${place}: a ground material is out of range`);
  }
}

/** Reads the chunks of the ground. */
export async function readGround(container: Container): Promise<Ground> {
  const place = container.source.name;
  const names = ["GVERTICE", "GINDICES", "GRANGES", "GMATERIA", "GIMAGES"];
  const [vertices, indexBytes, rangeBytes, materialBytes, imageBytes] = await Promise.all(
    names.map((name) => bytesOf(container, name)),
  );
  const rangeWords = new Uint32Array(rangeBytes.buffer, 0, rangeBytes.length / 4);
  const ranges: GroundRange[] = [];
  for (let i = 0; i < rangeWords.length; i += 4)
    ranges.push({
      level: rangeWords[i],
      material: rangeWords[i + 1],
      firstIndex: rangeWords[i + 2],
      indexCount: rangeWords[i + 3],
    });
  const view = new DataView(materialBytes.buffer, 0, materialBytes.length);
  const materials: GroundMaterial[] = [];
  for (let at = 0; at < materialBytes.length; at += 32) {
    const float = (word: number) => view.getFloat32(at + 4 * word, true);
    const image = view.getUint32(at + 24, true);
    materials.push({
      baseColor: [float(0), float(1), float(2), float(3)],
      roughness: float(4),
      metallic: float(5),
      image: image === noImage ? -1 : image,
      isDoubleSided: (view.getUint32(at + 28, true) & 1) !== 0,
    });
  }
  const ground: Ground = {
    vertices,
    vertexCount: vertices.length / groundVertexBytes,
    indices: new Uint32Array(indexBytes.buffer, 0, indexBytes.length / 4),
    ranges,
    materials,
    images: imagesOf(imageBytes, `${place}: ground images`),
  };
  verify(ground, place);
  return ground;
}
