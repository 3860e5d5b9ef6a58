import { BladeArrays, bladeId, bladeWords, unpackBlades, verifyBlades } from "./blades";
import { Chunk, Container } from "./container";
import { fail } from "./error";
import { Ground, readGround } from "./ground";
import { Patches } from "./patches";
import { Seeds } from "./seeds";
import { BufferSource, FetchOptions, openSource } from "./source";
import { Defaults, parseCover, parseDefaults, parseSpecies, Species } from "./texts";

/** Blades of a page: what is fetched at once, or not at all. */
export const pageBlades = 1024;

/** Pages that one request fetches at most, so that a picture is not late for a single request. */
const pagesPerRequest = 256;

/** A field: all but its blades is here; blades come by pages. */
export class Field {
  /** Name or address of the file, for messages. */
  readonly name: string;
  /** World position of the field's origin [m]: world = origin + position. */
  readonly origin: [number, number, number];
  readonly version: { major: number; minor: number };
  readonly bladeCount: number;
  readonly pageCount: number;
  /** Packed blades, four words each; those of pages that are not here are 0. */
  readonly packed: Uint32Array;
  private readonly states: Uint8Array;
  private present = 0;
  private keys: Uint32Array | undefined;

  private constructor(
    private readonly container: Container,
    private readonly bladeChunk: Chunk,
    readonly patches: Patches,
    readonly species: readonly Species[],
    readonly defaults: Defaults,
    readonly ground: Ground,
    /** Leaf area of the meadow relative to that of the blades. */
    readonly thinned: number,
    /** What bears, from which more blades grow than the stored ones; undefined if these are all. */
    readonly seeds: Seeds | undefined,
  ) {
    this.name = container.source.name;
    this.origin = container.origin;
    this.version = container.version;
    this.bladeCount = bladeChunk.elementCount;
    this.pageCount = Math.ceil(this.bladeCount / pageBlades);
    this.packed = new Uint32Array(bladeWords * this.bladeCount);
    this.states = new Uint8Array(this.pageCount);
  }

  /** Reads all but the blades. */
  static async open(container: Container): Promise<Field> {
    const place = container.source.name;
    const bladeChunk = container.need("BLADES");
    if (bladeChunk.rawBytes !== bladeChunk.storedBytes)
      fail("unsupported", `${place}: chunk BLADES is compressed, which this version does not map`);
    container.need("SPECIES");
    container.need("DEFAULTS");
    const [patchBytes, species, defaults, cover, ground] = await Promise.all([
      container.bytes(container.need("PATCHES")),
      container.text("SPECIES"),
      container.text("DEFAULTS"),
      container.text("COVER"),
      readGround(container),
    ]);
    const patches = new Patches(patchBytes);
    patches.verify(bladeChunk.elementCount, place);
    const kinds = parseSpecies(species!, `${place}: species`);
    return new Field(
      container,
      bladeChunk,
      patches,
      kinds,
      parseDefaults(defaults!, `${place}: defaults`),
      ground,
      parseCover(cover, `${place}: cover`),
      await Seeds.open(container, kinds.length),
    );
  }

  /** Whether the file says what bears. */
  get hasSeeds(): boolean {
    return this.seeds !== undefined;
  }

  /** Whether the rest of the meadow grows from seeds: some of its blades are stored, but not all. */
  get isSown(): boolean {
    const stored = this.seeds?.meadow.stored ?? 1;
    return this.bladeCount > 0 && stored > 0 && stored < 1;
  }

  /** Hash of the packed blades, which tells fields apart. */
  get bladesHash(): bigint {
    return this.bladeChunk.hash;
  }

  /** Bytes received so far. */
  get received(): number {
    return this.container.source.received;
  }

  /** Pages that are here. */
  get presentPages(): number {
    return this.present;
  }

  /** Whether all blades are here. */
  get isComplete(): boolean {
    return this.present === this.pageCount;
  }

  /** Whether all blades from `first` on are here. */
  has(first: number, count: number): boolean {
    if (count <= 0) return true;
    for (let p = Math.floor(first / pageBlades); p <= Math.floor((first + count - 1) / pageBlades); ++p)
      if (this.states[p] !== 2) return false;
    return true;
  }

  /** Whether a page is neither here nor under way. */
  isMissing(page: number): boolean {
    return this.states[page] === 0;
  }

  /** Whether a blade is a ribbon on the stalk of a compound plant, without a root of its own. */
  isRibbon(blade: number): boolean {
    const look = this.packed[bladeWords * blade + 3];
    return look >>> 24 > 0 && this.species[(look >>> 21) & 7].organs.length > 0;
  }

  /**
   * Fetches pages `from` up to, not including, `to` that are neither here nor under way. Blades are checked; their
   * hash is checked when all are here, so that a damaged file is an error of the last page at the latest.
   */
  async loadPages(from: number, to: number): Promise<void> {
    const runs: [number, number][] = [];
    for (let page = from; page < to; ++page) {
      if (this.states[page] !== 0) continue;
      this.states[page] = 1;
      const last = runs[runs.length - 1];
      if (last && last[1] === page && page - last[0] < pagesPerRequest) last[1] = page + 1;
      else runs.push([page, page + 1]);
    }
    await Promise.all(runs.map(([begin, end]) => this.loadRun(begin, end)));
  }

  /** Fetches all blades, and compares them with their hash. */
  async loadAll(): Promise<void> {
    for (let page = 0; page < this.pageCount; page += pagesPerRequest)
      await this.loadPages(page, Math.min(page + pagesPerRequest, this.pageCount));
    if (this.pageCount === 0) await this.checkBlades();
  }

  /** Blades as arrays; all of them, or `count` from `first` on. They must be here. */
  blades(first = 0, count = this.bladeCount - first): BladeArrays {
    if (first < 0 || count < 0 || first + count > this.bladeCount)
      fail("usage", `${this.name}: blades ${first} to ${first + count} of ${this.bladeCount}`);
    if (!this.has(first, count))
      fail("usage", `${this.name}: some of the blades ${first} to ${first + count} are not loaded`);
    return unpackBlades(this.packed, this.patches, first, count);
  }

  /** The id of a blade, as in the CSV export. Call loadKeys() before. */
  idOf(blade: number): bigint {
    return bladeId(this.keys ?? new Uint32Array(0), blade);
  }

  /** Fetches the origins of all blades, which only idOf() needs. */
  async loadKeys(): Promise<void> {
    const chunk = this.container.find("KEYS");
    if (!chunk || this.keys) return;
    if (chunk.elementCount !== 0 && chunk.elementCount !== this.bladeCount)
      fail("input", `${this.name}: ${chunk.elementCount} keys for ${this.bladeCount} blades`);
    const bytes = await this.container.bytes(chunk);
    this.keys = new Uint32Array(bytes.buffer, 0, bytes.length / 4);
  }

  /** The JSON text of the file's provenance. */
  async provenance(): Promise<string> {
    return (await this.container.text("PROVENAN")) ?? "{}";
  }

  /** Compares what only the whole file tells: the bytes between chunks, and chunks that are not drawn. */
  async verifyRest(): Promise<void> {
    await this.container.checkPadding();
    for (const chunk of this.container.chunks) await this.container.bytes(chunk);
    await this.loadKeys();
  }

  private async loadRun(begin: number, end: number): Promise<void> {
    const first = begin * pageBlades;
    const count = Math.min(end * pageBlades, this.bladeCount) - first;
    const from = this.bladeChunk.offset + 16 * first;
    let bytes: Uint8Array;
    try {
      bytes = await this.container.source.read(from, from + 16 * count);
    } catch (error) {
      // They may be asked for again.
      this.states.fill(0, begin, end);
      throw error;
    }
    new Uint8Array(this.packed.buffer).set(bytes, 16 * first);
    verifyBlades(this.packed, this.patches, this.species, first, count, this.name);
    this.states.fill(2, begin, end);
    this.present += end - begin;
    if (this.isComplete) await this.checkBlades();
  }

  private async checkBlades(): Promise<void> {
    await this.container.checkHash(this.bladeChunk, new Uint8Array(this.packed.buffer));
  }
}

/** Reads a field that is in memory, whole. `name` is for messages. */
export async function readField(file: ArrayBuffer | Uint8Array, name = "field"): Promise<Field> {
  // Not a Buffer of Node.js, whose slice() copies nothing.
  const bytes = file instanceof Uint8Array ? new Uint8Array(file.buffer, file.byteOffset, file.length) : new Uint8Array(file);
  const field = await Field.open(await Container.open(new BufferSource(name, bytes)));
  await field.loadAll();
  await field.verifyRest();
  return field;
}

/** Opens a field on a server, without its blades: see Field.loadPages() and loadAll(). */
export async function openField(address: string, options: FetchOptions = {}): Promise<Field> {
  return Field.open(await Container.open(await openSource(address, options)));
}
