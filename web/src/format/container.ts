import { decompress } from "fzstd";

import { fail } from "./error";
import { Source } from "./source";
import { xxh3, xxh3InSteps } from "./xxh3";

const magic = "SWARD\r\n\x1a";
const majorVersion = 1;
const minorVersion = 3;
const endianMark = 0x01020304;
const headerBytes = 64;
const entryBytes = 64;
const maxChunks = 64;
const alignment = 64;
const critical = 1;
const compressed = 2;

/** Largest compressed claim: 256 MB, and 4096 bytes for each compressed one (docs/field_format.md). */
const plainBytes = 256 * 1024 * 1024;
const largestRatio = 4096;
const largestWindow = 32 * 1024 * 1024;

/** Bytes of an element of the chunks that this reader knows; 0: text or bytes. */
const knownChunks: Record<string, number> = {
  PATCHES: 104, BLADES: 16, KEYS: 8, SPECIES: 1, GVERTICE: 28, GINDICES: 4, GRANGES: 16,
  GMATERIA: 32, GIMAGES: 1, DEFAULTS: 1, COVER: 1, SEEDS: 1, SEEDCELL: 48, SEEDDATA: 1, PROVENAN: 1,
};

/** An entry of the chunk table. */
export interface Chunk {
  readonly name: string;
  readonly offset: number;
  readonly storedBytes: number;
  readonly rawBytes: number;
  readonly hash: bigint;
  readonly flags: number;
  readonly elementBytes: number;
  readonly elementCount: number;
}

const hex = (value: number, digits = 0) => `0x${(value >>> 0).toString(16).padStart(digits, "0")}`;

/** Header and chunk table of a field, read and verified. */
export class Container {
  readonly version: { major: number; minor: number };
  /** World position of the field's origin [m]. */
  readonly origin: [number, number, number];
  readonly chunks: Chunk[] = [];

  /** `head`: the first bytes of the file, at least header and table. */
  private constructor(
    readonly source: Source,
    private readonly head: Uint8Array,
  ) {
    const place = source.name;
    const view = new DataView(head.buffer, head.byteOffset, head.length);
    for (let i = 0; i < magic.length; ++i)
      if (head[i] !== magic.charCodeAt(i))
        fail("input", `${place}: not a field file (it does not begin with "SWARD")`);
    const mark = view.getUint32(12, true);
    if (mark !== endianMark)
      fail("input", `${place}: the byte order mark is ${hex(mark, 8)} instead of ${hex(endianMark, 8)}`);
    this.version = { major: view.getUint16(8, true), minor: view.getUint16(10, true) };
    if (this.version.major > majorVersion)
      fail(
        "unsupported",
        `${place}: field format version ${this.version.major}.${this.version.minor}; ` +
          `this program reads up to version ${majorVersion}.${minorVersion}`,
      );
    if (this.version.major === 0) fail("input", `${place}: field format version 0 does not exist`);
    const size = view.getBigUint64(16, true);
    if (size !== BigInt(source.size))
      fail(
        "input",
        `${place}: ${source.size} bytes instead of ${size}: ` +
          (BigInt(source.size) < size ? "truncated" : "bytes follow its end"),
      );
    const count = view.getUint32(24, true);
    if (count > maxChunks) fail("input", `${place}: ${count} chunks, more than ${maxChunks}`);
    if (count === 0) fail("input", `${place}: no chunks`);
    const end = headerBytes + count * entryBytes;
    if (end > source.size)
      fail("input", `${place}: the table of ${count} chunks does not fit into ${source.size} bytes`);
    const hashed = head.slice(0, end);
    hashed.fill(0, 56, 64);
    if (xxh3(hashed) !== view.getBigUint64(56, true))
      fail("input", `${place}: header or chunk table is damaged (hash differs)`);
    this.origin = [32, 40, 48].map((at) => view.getFloat64(at, true)) as [number, number, number];
    if (!this.origin.every(Number.isFinite)) fail("input", `${place}: the origin is not finite`);
    this.readTable(view, count, end);
  }

  /** Reads header and table of a field. */
  static async open(source: Source): Promise<Container> {
    if (source.size < headerBytes)
      fail(
        "input",
        `${source.name}: ${source.size} bytes, too short for the header of a field (${headerBytes})`,
      );
    const bytes = Math.min(source.size, headerBytes + maxChunks * entryBytes);
    return new Container(source, await source.read(0, bytes));
  }

  private readTable(view: DataView, count: number, end: number): void {
    const place = this.source.name;
    let at = end;
    for (let i = 0; i < count; ++i) {
      const base = headerBytes + i * entryBytes;
      const name = Array.from(this.head.subarray(base, base + 8), (c) =>
        c >= 32 && c < 127 ? String.fromCharCode(c) : "?",
      )
        .join("")
        .trimEnd();
      const number = (offset: number): number => {
        const value = view.getBigUint64(base + offset, true);
        return value > BigInt(Number.MAX_SAFE_INTEGER) ? Infinity : Number(value);
      };
      const chunk: Chunk = {
        name,
        offset: number(8),
        storedBytes: number(16),
        rawBytes: number(24),
        hash: view.getBigUint64(base + 32, true),
        flags: view.getUint32(base + 40, true),
        elementBytes: view.getUint32(base + 44, true),
        elementCount: number(48),
      };
      if (
        chunk.offset % alignment !== 0 ||
        chunk.offset < at ||
        chunk.offset - at >= alignment ||
        chunk.storedBytes > this.source.size - chunk.offset
      )
        fail(
          "input",
          `${place}: chunk ${name} at ${chunk.offset} with ${chunk.storedBytes} bytes does not fit`,
        );
      if ((chunk.flags & ~(critical | compressed)) !== 0)
        fail("unsupported", `${place}: chunk ${name} has unknown flags ${hex(chunk.flags)}`);
      const isCompressed = (chunk.flags & compressed) !== 0;
      if (
        chunk.elementBytes === 0 ||
        chunk.elementCount * chunk.elementBytes !== chunk.rawBytes ||
        (!isCompressed && chunk.rawBytes !== chunk.storedBytes)
      )
        fail(
          "input",
          `${place}: chunk ${name} has ${chunk.elementCount} elements of ` +
            `${chunk.elementBytes} bytes in ${chunk.rawBytes} bytes`,
        );
      const known = knownChunks[name];
      if (known === undefined && (chunk.flags & critical) !== 0)
        fail("unsupported", `${place}: needs chunk ${name}, which this version does not know`);
      if (known !== undefined && known !== chunk.elementBytes)
        fail(
          "input",
          `${place}: elements of chunk ${name} have ${chunk.elementBytes} bytes instead of ${known}`,
        );
      this.chunks.push(chunk);
      at = chunk.offset + chunk.storedBytes;
    }
  }

  /** The first chunk of this name; undefined if there is none. */
  find(name: string): Chunk | undefined {
    return this.chunks.find((chunk) => chunk.name === name);
  }

  /** The same; an error if it is missing. */
  need(name: string): Chunk {
    return this.find(name) ?? fail("input", `${this.source.name}: chunk ${name} is missing`);
  }

  /** Checks that the bytes between chunks are zero. Needs the whole file. */
  async checkPadding(): Promise<void> {
    let at = headerBytes + this.chunks.length * entryBytes;
    const check = async (from: number, to: number) => {
      const bytes = await this.source.read(from, to);
      const found = bytes.findIndex((byte) => byte !== 0);
      if (found >= 0)
        fail("input", `${this.source.name}: byte ${from + found} between chunks is not zero`);
    };
    for (const chunk of this.chunks) {
      await check(at, chunk.offset);
      at = chunk.offset + chunk.storedBytes;
    }
    await check(at, this.source.size);
  }

  /** Compares the stored bytes of a chunk with its hash. */
  async checkHash(chunk: Chunk, stored: Uint8Array): Promise<void> {
    if ((await xxh3InSteps(stored)) !== chunk.hash)
      fail("input", `${this.source.name}: chunk ${chunk.name} is damaged (hash differs)`);
  }

  /** The bytes of a chunk, verified and decompressed. Their buffer begins with them. */
  async bytes(chunk: Chunk): Promise<Uint8Array> {
    const stored = await this.source.read(chunk.offset, chunk.offset + chunk.storedBytes);
    await this.checkHash(chunk, stored);
    if ((chunk.flags & compressed) === 0) return stored.slice();
    return this.decompressed(chunk, stored);
  }

  private decompressed(chunk: Chunk, stored: Uint8Array): Uint8Array {
    if (chunk.elementCount === 0) return new Uint8Array(0);
    const place = `${this.source.name}: chunk ${chunk.name}`;
    const planes = unpackFrame(stored, chunk.rawBytes, place);
    // First all first bytes of the elements, then all second ones: back to elements.
    const { elementBytes, elementCount } = chunk;
    if (elementBytes === 1) return planes;
    const raw = new Uint8Array(chunk.rawBytes);
    for (let plane = 0; plane < elementBytes; ++plane) {
      const from = plane * elementCount;
      for (let i = 0, to = plane; i < elementCount; ++i, to += elementBytes) raw[to] = planes[from + i];
    }
    return raw;
  }

  /** The text of a chunk; undefined if it is absent. */
  async text(name: string): Promise<string | undefined> {
    const chunk = this.find(name);
    if (!chunk) return undefined;
    const bytes = await this.bytes(chunk);
    try {
      return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
      fail("input", `${this.source.name}: chunk ${name} is not UTF-8`);
    }
  }
}

/**
 * Undoes zstd, with the bounds of docs/field_format.md. `rawBytes`: what the frame must hold; without it what it
 * states.
 */
export function unpackFrame(stored: Uint8Array, rawBytes: number | undefined, place: string): Uint8Array {
  const frame = frameOf(stored);
  const bytes = rawBytes ?? frame?.content ?? 0;
  if (bytes > plainBytes + largestRatio * stored.length)
    fail(
      "input",
      `${place}: ${stored.length} compressed bytes claim to hold ${bytes}, ` +
        `more than ${plainBytes} and ${largestRatio} for each`,
    );
  if (!frame || frame.content !== bytes)
    fail("input", `${place}: the compressed data does not hold ${bytes} bytes`);
  if (frame.window > largestWindow)
    fail("input", `${place}: its window is ${frame.window} bytes, more than ${largestWindow}`);
  const plain = new Uint8Array(bytes);
  let result: Uint8Array;
  try {
    result = decompress(stored, plain);
  } catch {
    fail("input", `${place}: the compressed data is damaged`);
  }
  if (result.length !== bytes) fail("input", `${place}: decompresses to ${result.length} bytes instead of ${bytes}`);
  return plain;
}

/** Content size and window of a zstd frame (RFC 8878, 3.1.1.1); undefined if it states no size. */
function frameOf(bytes: Uint8Array): { content: number; window: number } | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 18 && bytes.length < 6) return undefined;
  if (view.getUint32(0, true) !== 0xfd2fb528) return undefined;
  const descriptor = bytes[4];
  const isSingle = (descriptor & 32) !== 0;
  let at = 5;
  let window = 0;
  if (!isSingle) {
    const exponent = bytes[at] >> 3;
    window = 2 ** (10 + exponent);
    window += (window / 8) * (bytes[at] & 7);
    ++at;
  }
  at += [0, 1, 2, 4][descriptor & 3];
  const size = descriptor >> 6;
  let content: number;
  if (size === 0 && !isSingle) return undefined;
  if (at + [1, 2, 4, 8][size] > bytes.length) return undefined;
  if (size === 0) content = bytes[at];
  else if (size === 1) content = view.getUint16(at, true) + 256;
  else if (size === 2) content = view.getUint32(at, true);
  else content = Number(view.getBigUint64(at, true));
  return { content, window: isSingle ? content : window };
}
