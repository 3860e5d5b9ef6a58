import { fail } from "./error";
import { parseJson, SettingsReader } from "./settings";
import type { Container } from "./container";

/** A kind of grass as the sower knows it: shared::SowSpecies. Ranges are [least, range]. */
export interface SowSpecies {
  share: number;
  height: number[];
  width: number[];
  stiffness: number[];
  clumping: number;
  facing: number;
  ribbons: number;
}

/** The chunk SEEDS: field::SeedMeadow. */
export interface SeedMeadow {
  /** Two words: the higher one first. */
  seed: [number, number];
  density: number;
  scale: number;
  clumpSpacing: number;
  /** The stored blades have the ranks below. */
  stored: number;
  /** Factor on the widths of the stored blades. */
  storedWidening: number;
  unitBits: number;
  levels: number;
  isMixed: boolean;
  heightWaves: number;
  drifts: number;
  sparseHeight: number;
  wideVariation: number;
  creaseReach: number;
  creaseBlend: number;
  vertical: number;
  isRadial: boolean;
  up: number[];
  highest: number;
  widest: number;
  species: SowSpecies[];
}

const facings = ["outward", "shared", "free"] as const;
const longest = 1e6;
const farthestOrigin = 1e12;
const maxSpecies = 8;

function parseSeed(text: string, place: string): [number, number] {
  if (!/^[0-9a-f]{1,16}$/i.test(text))
    fail("input", `${place}: "${text}" is not a number of up to 16 hexadecimal digits`);
  const digits = text.padStart(16, "0");
  return [parseInt(digits.slice(0, 8), 16), parseInt(digits.slice(8), 16)];
}

/** Reads the chunk SEEDS; the same as field::parseSeedMeadow(). */
export function parseSeedMeadow(text: string, place: string): SeedMeadow {
  const reader = new SettingsReader(parseJson(text, place), place);
  const flag = (key: string): boolean => {
    const value = reader.value(key) ?? false;
    if (typeof value !== "boolean") fail("input", `${place}: expected true or false, found ${JSON.stringify(value)}`);
    return value;
  };
  const meadow: SeedMeadow = {
    seed: parseSeed(reader.text("seed", ""), place),
    density: reader.number("density", 0, 0, 1e15),
    scale: reader.number("scale", 1, 1e-3, 1e5),
    clumpSpacing: reader.number("clump_spacing", 0, 0, 1e9),
    stored: reader.number("stored", 0, 0, 1),
    storedWidening: reader.number("stored_widening", 1, 1, 2),
    unitBits: reader.number("unit_bits", 20, 11, 24),
    levels: reader.number("levels", 0, 0, 10),
    isMixed: flag("mixed"),
    heightWaves: reader.number("height_waves", 0, 0, 0.5),
    drifts: reader.number("drifts", 0, 0, 1),
    sparseHeight: reader.number("sparse_height", 1, 0, 1),
    wideVariation: reader.number("wide_variation", 0, 0, 1),
    creaseReach: reader.number("crease_reach", 0, 0, longest),
    creaseBlend: reader.number("crease_blend", 0, 0, 1),
    vertical: reader.number("vertical", 0, 0, 1),
    isRadial: flag("radial"),
    up: reader.vector("up", [0, 1, 0], -farthestOrigin, farthestOrigin),
    highest: reader.number("highest", 1, 1e-9, longest),
    widest: reader.number("widest", 1, 1e-9, longest),
    species: reader.array("species").map((entry, i): SowSpecies => {
      const one = new SettingsReader(entry, `${place}: species ${i}`);
      const species: SowSpecies = {
        share: one.number("share", 0, 0, 1),
        height: one.vector("height", [0, 0], 0, longest),
        width: one.vector("width", [0, 0], 0, longest),
        stiffness: one.vector("stiffness", [0, 0], 0, 1),
        clumping: one.number("clumping", 0, 0, 1),
        facing: one.word("facing", facings, 2),
        ribbons: one.number("ribbons", 0, 0, 63),
      };
      one.finish();
      return species;
    }),
  };
  for (const key of ["unitBits", "levels"] as const)
    if (!Number.isInteger(meadow[key])) fail("input", `${place}: ${meadow[key]} is not a whole number`);
  reader.finish();
  if (meadow.species.length === 0 || meadow.species.length > maxSpecies)
    fail("input", `${place}: expected an array of 1 to ${maxSpecies} species`);
  return meadow;
}

const entryBytes = 48;

/** What bears in a field. Frames of cells are fetched one by one. */
export class Seeds {
  /** Numbers of cells. */
  readonly count: number;
  private readonly view: DataView;

  private constructor(
    private readonly container: Container,
    private readonly offset: number,
    readonly meadow: SeedMeadow,
    /** The chunk SEEDCELL. */
    readonly entries: Uint8Array,
  ) {
    this.count = entries.length / entryBytes;
    this.view = new DataView(entries.buffer, entries.byteOffset, entries.length);
  }

  /** The seeds of a field; undefined without any. */
  static async open(container: Container, speciesCount: number): Promise<Seeds | undefined> {
    const text = await container.text("SEEDS");
    if (text === undefined) return undefined;
    const place = container.source.name;
    const meadow = parseSeedMeadow(text, `${place}: seeds`);
    if (meadow.species.length !== speciesCount)
      fail("input", `${place}: the seeds have ${meadow.species.length} species, of ${speciesCount} that there are`);
    const data = container.need("SEEDDATA");
    const entries = await container.bytes(container.need("SEEDCELL"));
    const seeds = new Seeds(container, data.offset, meadow, entries);
    seeds.verify(data.storedBytes, place);
    return seeds;
  }

  /** The zstd frame of a cell. */
  async frame(index: number): Promise<Uint8Array> {
    const at = this.offset + this.number(index, 32);
    return (await this.container.source.read(at, at + this.number(index, 40))).slice();
  }

  private number(index: number, at: number): number {
    return Number(this.view.getBigUint64(index * entryBytes + at, true));
  }

  private cell(index: number): number[] {
    return [0, 4, 8].map((at) => this.view.getInt32(index * entryBytes + at, true));
  }

  private verify(bytes: number, place: string): void {
    let at = 0;
    for (let i = 0; i < this.count; ++i) {
      if (i > 0) {
        const [a, b] = [this.cell(i - 1), this.cell(i)];
        const axis = [0, 1, 2].find((k) => a[k] !== b[k]);
        if (axis === undefined || a[axis] > b[axis])
          fail("input", `${place}: cell ${i} of the seeds is out of order`);
      }
      const [offset, size] = [this.number(i, 32), this.number(i, 40)];
      if (offset !== at || size > bytes - at)
        fail("input", `${place}: cell ${i} of the seeds, ${size} bytes at ${offset}, does not fit`);
      at += size;
    }
    if (at !== bytes) fail("input", `${place}: bytes follow the last cell of the seeds`);
  }
}
