import { fail, SwardError } from "../format/error";
import type { ErrorKind } from "../format/error";
import { patchWords } from "../format/patches";
import type { SeedMeadow } from "../format/seeds";
import type { Species } from "../format/texts";

/** What is sown at once: half of the ranks of one level in a cube of a 32 m cell (field::SowUnit). */
export interface SowUnit {
  /** Number of the cell in the chunk SEEDCELL. */
  cell: number;
  level: number;
  half: number;
  place: [number, number, number];
}

/** A unit that is wanted, or a cell that must be opened first. */
export interface WantedUnit extends SowUnit {
  /** The share that is drawn at its nearest place over its lowest rank: above 1. */
  score: number;
  isCell: boolean;
}

/** What decides which blades an eye draws: members of shared::Eyepoint. */
export interface SowEye {
  eye: readonly number[];
  drawDistance: number;
  pixelsPerUnit: number;
  lodThreshold: number;
  lodWidth: number;
  sparseFrom: number;
  sparseLeast: number;
}

/** The blades of a unit: field::GrownUnit. The arrays are copies. */
export interface GrownUnit {
  /** 26 words a patch; its first blade counts from this unit's. */
  patches: Uint32Array;
  /** Four words a blade. */
  blades: Uint32Array;
  /** Two words a blade: triangle and candidate. */
  keys: Uint32Array;
  /** The patch that bounds all. */
  whole: Uint32Array;
  /** [m] */
  widest: number;
}

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  take(bytes: number): number;
  give(address: number): void;
  begin(numbers: number, entries: number, count: number): void;
  openCell(index: number, bytes: number, count: number): void;
  closeCell(index: number): void;
  grow(unit: number): number;
  find(eyes: number, count: number): number;
  found(): number;
  score(unit: number, eyes: number, count: number): number;
  sparseDistance(room: number, bladesPerArea: number, blades: number, ...rest: number[]): number;
}

const kinds: Record<number, ErrorKind> = { 1: "usage", 2: "io", 3: "input", 4: "runtime", 5: "unsupported" };
const unitWords = 8;
const eyeNumbers = 9;

/** All numbers of a field that the module needs, in the order in which begin() of sow_module.cpp reads them. */
export function numbersOf(meadow: SeedMeadow, species: readonly Species[], origin: readonly number[]): Float64Array {
  const flag = (value: boolean) => (value ? 1 : 0);
  const m = meadow;
  const list = [
    ...m.seed, m.density, m.scale, m.clumpSpacing, m.stored, m.unitBits, m.levels, flag(m.isMixed), m.heightWaves,
    m.drifts, m.sparseHeight, m.wideVariation, m.creaseReach, m.creaseBlend, m.vertical, flag(m.isRadial), ...m.up,
    m.highest, m.widest, ...origin, m.species.length,
  ];
  m.species.forEach((one, i) => {
    list.push(one.share, ...one.height, ...one.width, ...one.stiffness, one.clumping, one.facing, one.ribbons);
    const organs = species[i].organs;
    list.push(organs.length);
    for (const organ of organs) list.push(organ.count, ...organ.length, organ.width, organ.variation);
  });
  return Float64Array.from(list);
}

/** The sower of the viewer, compiled from its C++ sources (web/sow). One field for each. */
export class SowModule {
  private readonly exports: Exports;
  private readonly unit: number;
  private eyes = 0;
  private eyeCount = 0;

  /** `place` is for messages. */
  constructor(module: WebAssembly.Module, place: string) {
    const refuse = (kind: number, message: number, bytes: number): never => {
      const text = new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, message, bytes));
      throw new SwardError(kinds[kind] ?? "runtime", `${place}: ${text}`);
    };
    this.exports = new WebAssembly.Instance(module, { sward: { refuse } }).exports as unknown as Exports;
    this.exports._initialize();
    this.unit = this.exports.take(4 * unitWords);
  }

  begin(numbers: Float64Array, entries: Uint8Array): void {
    const at = this.put(numbers);
    const table = this.put(entries);
    this.exports.begin(at, table, entries.length / 48);
    this.exports.give(table);
    this.exports.give(at);
  }

  /** Opens a cell: `plain` is its frame without zstd. */
  openCell(index: number, plain: Uint8Array): void {
    const at = this.put(plain);
    this.exports.openCell(index, at, plain.length);
    this.exports.give(at);
  }

  closeCell(index: number): void {
    this.exports.closeCell(index);
  }

  /** Grows a unit of an open cell. */
  grow(unit: SowUnit): GrownUnit {
    this.writeUnit(unit);
    const at = this.exports.grow(this.unit);
    const { buffer } = this.exports.memory;
    const [patches, patchCount, blades, bladeCount, keys, whole] = new Uint32Array(buffer, at, 6);
    const words = (from: number, count: number) => new Uint32Array(buffer, from, count).slice();
    return {
      patches: words(patches, patchWords * patchCount),
      blades: words(blades, 4 * bladeCount),
      keys: words(keys, 2 * bladeCount),
      whole: words(whole, patchWords),
      widest: new Float32Array(buffer, at + 24, 1)[0],
    };
  }

  /** The eyes of find() and score(). */
  look(eyes: readonly SowEye[]): void {
    const numbers = eyes.flatMap((one) => [
      ...one.eye, one.drawDistance, one.pixelsPerUnit, one.lodThreshold, one.lodWidth, one.sparseFrom, one.sparseLeast,
    ]);
    if (this.eyes !== 0) this.exports.give(this.eyes);
    this.eyes = this.put(Float64Array.from(numbers));
    this.eyeCount = numbers.length / eyeNumbers;
  }

  /** All that the eyes want, in falling order of scores. */
  find(): WantedUnit[] {
    const count = this.exports.find(this.eyes, this.eyeCount);
    const at = this.exports.found();
    const words = new Uint32Array(this.exports.memory.buffer, at, unitWords * count);
    const floats = new Float32Array(this.exports.memory.buffer, at, unitWords * count);
    return Array.from({ length: count }, (_, i) => {
      const w = words.subarray(unitWords * i, unitWords * (i + 1));
      return { score: floats[unitWords * i], isCell: w[1] !== 0, cell: w[2], level: w[3], half: w[4], place: [w[5], w[6], w[7]] };
    });
  }

  /** Score of any unit. */
  score(unit: SowUnit): number {
    this.writeUnit(unit);
    return this.exports.score(this.unit, this.eyes, this.eyeCount);
  }

  /** render::sparseDistance(). */
  sparseDistance(
    room: number,
    bladesPerArea: number,
    blades: number,
    low: readonly number[],
    high: readonly number[],
    full: number,
    nearest: number,
  ): number {
    return this.exports.sparseDistance(room, bladesPerArea, blades, ...low, ...high, full, nearest);
  }

  private writeUnit(unit: SowUnit): void {
    new Uint32Array(this.exports.memory.buffer, this.unit, unitWords).set([0, 0, unit.cell, unit.level, unit.half, ...unit.place]);
  }

  /** A copy in the module's memory, at a multiple of 16. */
  private put(array: Float64Array | Uint8Array): number {
    const at = this.exports.take(Math.max(array.byteLength, 1));
    new Uint8Array(this.exports.memory.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
    return at;
  }
}

/** Compiles the module. `bytes`: sow.wasm. */
export async function compileSower(bytes: BufferSource, place: string): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(bytes);
  } catch {
    fail("unsupported", `${place}: the sower does not run in this browser`);
  }
}
