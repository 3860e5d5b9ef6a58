import { fail, SwardError } from "./error";
import { address as addressRule, expectOption } from "./options";

/** Bytes of a file, whole or by parts. */
export interface Source {
  /** For messages: the file's name or address. */
  readonly name: string;
  /** Bytes of the file. */
  readonly size: number;
  /** Whether all bytes are here already: the server has no ranges, or the caller gave a buffer. */
  readonly isWhole: boolean;
  /** Bytes that have been received so far. */
  readonly received: number;
  /** Bytes from `from` up to, not including, `to`. */
  read(from: number, to: number): Promise<Uint8Array>;
}

/** A file that is in memory. */
export class BufferSource implements Source {
  readonly isWhole = true;
  readonly size: number;
  readonly received: number;

  constructor(
    readonly name: string,
    private readonly bytes: Uint8Array,
  ) {
    this.size = bytes.length;
    this.received = bytes.length;
  }

  async read(from: number, to: number): Promise<Uint8Array> {
    return this.bytes.subarray(from, to);
  }
}

/** How a file is fetched. */
export interface FetchOptions {
  /** Stops the transfer. */
  signal?: AbortSignal;
  /** Told of bytes received of `total`, while the whole file comes. */
  onProgress?(received: number, total: number): void;
  /** Instead of the browser's fetch(). */
  fetch?: typeof fetch;
  /** False: the whole file is fetched at once. */
  ranges?: boolean;
}

/** The first request: header, chunk table, and what follows. */
const firstBytes = 65536;

/** A file on a server that answers requests for ranges. */
class RangeSource implements Source {
  readonly isWhole = false;
  received: number;

  constructor(
    readonly name: string,
    readonly size: number,
    private readonly first: Uint8Array,
    private readonly get: (from: number, to: number) => Promise<Response>,
  ) {
    this.received = first.length;
  }

  async read(from: number, to: number): Promise<Uint8Array> {
    if (to <= this.first.length) return this.first.slice(from, to);
    const response = await this.get(from, to);
    if (response.status !== 206)
      fail("io", `${this.name}: status ${response.status} for bytes ${from} to ${to}, instead of 206`);
    const bytes = await bodyOf(response, this.name);
    this.received += bytes.length;
    if (bytes.length !== to - from)
      fail("io", `${this.name}: ${bytes.length} bytes of ${to - from} came: truncated`);
    return bytes;
  }
}

async function bodyOf(response: Response, name: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await response.arrayBuffer());
  } catch (error) {
    if (isAbort(error)) throw error;
    fail("io", `${name}: the connection ended before all bytes came`);
  }
}

async function bodyInParts(
  response: Response,
  name: string,
  onProgress: FetchOptions["onProgress"],
): Promise<Uint8Array> {
  if (!onProgress || !response.body) return bodyOf(response, name);
  const total = Number(response.headers.get("content-length") ?? 0);
  const reader = response.body.getReader();
  const parts: Uint8Array[] = [];
  let received = 0;
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      received += value.length;
      onProgress(received, Math.max(total, received));
    }
  } catch (error) {
    if (isAbort(error)) throw error;
    fail("io", `${name}: the connection ended after ${received} bytes`);
  }
  const bytes = new Uint8Array(received);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === "AbortError" && !(error instanceof SwardError);
}

/** Opens a file on a server: by ranges if it has them, else whole. */
export async function openSource(address: string, options: FetchOptions = {}): Promise<Source> {
  expectOption("openField", address, addressRule[0], addressRule[1](address as never));
  address = String(address);
  const doFetch = options.fetch ?? fetch;
  const get = async (range?: string): Promise<Response> => {
    try {
      return await doFetch(address, {
        headers: range ? { Range: range } : {},
        signal: options.signal ?? null,
      });
    } catch (error) {
      if (isAbort(error)) throw error;
      fail("io", `${address}: no answer from the server`);
    }
  };
  const byRanges = options.ranges ?? true;
  const response = await get(byRanges ? `bytes=0-${firstBytes - 1}` : undefined);
  const total = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
  if (response.status === 206 && total) {
    const first = await bodyOf(response, address);
    return new RangeSource(address, Number(total[1]), first, (from, to) =>
      get(`bytes=${from}-${to - 1}`),
    );
  }
  // An empty file has no range at all.
  if (response.status === 416) return new BufferSource(address, new Uint8Array(0));
  if (!response.ok) fail("io", `${address}: the server answers ${response.status}`);
  return new BufferSource(address, await bodyInParts(response, address, options.onProgress));
}
