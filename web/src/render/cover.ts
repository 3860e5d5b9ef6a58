import { heightSteps, toneBits } from "../generated/layout";
import { fail } from "../format/error";
import type { Field } from "../format/field";
import { openSource } from "../format/source";
import { Vec3 } from "../format/texts";
import { xxh3 } from "../format/xxh3";
import { fromHalf, toHalf } from "./half";

/** shared::Cover as `sward export` writes it into field.cover, and its corners. */
export interface Cover {
  /** For messages: the file's name or address; none of noCover. */
  name?: string;
  /** Hash of the field's chunk BLADES; none of noCover. */
  bladesHash?: bigint;
  /** field::areaFactor(): of the blades relative to height times width of their patches. */
  areaFactor: number;
  low: Vec3;
  cellsPerMetre: number;
  counts: Vec3;
  undergrowth: Vec3;
  sward: Vec3;
  thinned: number;
  structure: number;
  stepsPerMetre: number;
  leaves: number[];
  /** packGrass() of each corner; x varies fastest, then y, then z. */
  corners: Uint32Array;
}

/** CoverHead of src/interchange/page.cpp, then shared::Cover. */
const magic = "SWCOVER1";
const headBytes = 32;
const shapeBytes = headBytes + 112;

/** Reads field.cover, and compares it with its hash. */
export function parseCoverFile(bytes: ArrayBuffer, name: string): Cover {
  if (!(bytes instanceof ArrayBuffer)) fail("usage", `${name}: the bytes of a cover are not an ArrayBuffer`);
  const all = new Uint8Array(bytes);
  if (String.fromCharCode(...all.subarray(0, magic.length)) !== magic)
    fail("input", `${name}: not a cover of this version of Sward; "sward export" writes it beside the field`);
  if (bytes.byteLength < shapeBytes || bytes.byteLength % 4 !== 0)
    fail("input", `${name}: ${bytes.byteLength} bytes, not a cover of at least ${shapeBytes}: truncated`);
  const view = new DataView(bytes);
  if (xxh3(all.subarray(16)) !== view.getBigUint64(8, true)) fail("input", `${name}: damaged (hash differs)`);
  const float = (at: number) => view.getFloat32(headBytes + at, true);
  const word = (at: number) => view.getUint32(headBytes + at, true);
  const vector = (at: number): Vec3 => [float(at), float(at + 4), float(at + 8)];
  const counts: Vec3 = [word(24), word(28), word(32)];
  const corners = new Uint32Array(bytes, shapeBytes);
  if (counts[0] * counts[1] * counts[2] !== corners.length)
    fail("input", `${name}: ${corners.length} corners instead of ${counts.join("·")}`);
  return {
    name,
    bladesHash: view.getBigUint64(16, true),
    areaFactor: view.getFloat32(24, true),
    low: vector(8),
    cellsPerMetre: float(20),
    counts,
    undergrowth: vector(40),
    sward: vector(56),
    thinned: float(68),
    structure: float(72),
    stepsPerMetre: float(76),
    leaves: Array.from({ length: heightSteps / 2 }, (_, i) => word(80 + 4 * i)),
    corners,
  };
}

/** Halves hold 65 504. */
const largestLeafArea = 1000;

/**
 * The cover of the whole meadow from that of the stored blades of a field with seeds: it has `areaPerStored` as much
 * leaf area. SownView::leafArea() of src/render/sowing.
 */
export function sownCover(cover: Cover, areaPerStored: number): Cover {
  const corners = cover.corners.map((corner) => {
    const bits = corner & ~toneBits;
    const area = fromHalf(bits & 0xffff);
    if (!(area > 0)) return corner;
    const leaves = Math.min(area * areaPerStored, largestLeafArea);
    const heights = (fromHalf(bits >>> 16) / area) * leaves;
    // packGrass() rounds by half of what the tone takes.
    const halves = (toHalf(leaves) | (toHalf(heights) << 16)) + 0x20000;
    return ((halves & ~toneBits) | (corner & toneBits)) >>> 0;
  });
  return { ...cover, thinned: 1, corners };
}

/** Without a cover: no shade between blades. */
export const noCover: Cover = {
  areaFactor: 1, low: [0, 0, 0], cellsPerMetre: 0, counts: [0, 0, 0], undergrowth: [0.08, 0.09, 0.03], sward: [0.1, 0.16, 0.04],
  thinned: 1, structure: 0.2, stepsPerMetre: 1, leaves: Array(heightSteps / 2).fill(0), corners: new Uint32Array(1),
};

/** Leaf area of the meadow at a place: leafAreaAt() of shaders/shared/cover.h. */
export function leafAreaAt(cover: Cover, place: Vec3): number {
  const [nx, ny] = cover.counts;
  if (nx === 0) return 0;
  const cell = [0, 0, 0];
  const f = [0, 0, 0];
  for (let i = 0; i < 3; ++i) {
    const last = cover.counts[i] - 1;
    const at = Math.min(Math.max((place[i] - cover.low[i]) * cover.cellsPerMetre, 0), last);
    cell[i] = Math.min(Math.floor(at), last - 1);
    f[i] = at - cell[i];
  }
  let sum = 0;
  for (let corner = 0; corner < 8; ++corner) {
    let weight = 1;
    const at = cell.map((c, i) => {
      const far = (corner >> i) & 1;
      weight *= far ? f[i] : 1 - f[i];
      return c + far;
    });
    const bits = cover.corners[at[0] + nx * (at[1] + ny * at[2])] & ~toneBits;
    sum += weight * fromHalf(bits & 0xffff);
  }
  return sum;
}

/** leafProjectionOf() of shaders/shared/cover.h. */
export const leafProjectionOf = (cover: Cover): number => fromHalf(cover.leaves[0] & 0xffff);

/** Fetches field.cover. */
export async function coverAt(address: string): Promise<Cover> {
  const source = await openSource(address, { ranges: false });
  return parseCoverFile((await source.read(0, source.size)).slice().buffer as ArrayBuffer, address);
}

/** Fails if a cover is that of another field. */
export function checkCover(field: Field, cover: Cover): void {
  if (cover.bladesHash !== undefined && cover.bladesHash !== field.bladesHash)
    fail("input", `${cover.name}: the cover of another field than ${field.name}; "sward export" writes both`);
}
