// XXH3-64 with seed 0, as in docs/field_format.md. Short inputs use BigInt; long ones 32-bit halves, which are
// about fifty times as fast. The algorithm: https://github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md

const secretHex =
  "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221" +
  "b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8" +
  "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb" +
  "170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e";

const secret = Uint8Array.from(secretHex.match(/../g)!, (pair) => parseInt(pair, 16));
const secretView = new DataView(secret.buffer);
const secretWords = new Uint32Array(secret.buffer);

const mask = 0xffffffffffffffffn;
const prime32 = [0n, 0x9e3779b1n, 0x85ebca77n, 0xc2b2ae3dn];
const prime64 = [
  0n,
  0x9e3779b185ebca87n,
  0xc2b2ae3d27d4eb4fn,
  0x165667b19e3779f9n,
  0x85ebca77c2b2ae63n,
  0x27d4eb2f165667c5n,
];

const secretAt = (at: number) => secretView.getBigUint64(at, true);
const rotate = (x: bigint, bits: bigint) => ((x << bits) | (x >> (64n - bits))) & mask;

function swap64(x: bigint): bigint {
  let result = 0n;
  for (let i = 0n; i < 8n; ++i) result = (result << 8n) | ((x >> (8n * i)) & 255n);
  return result;
}

function foldedProduct(a: bigint, b: bigint): bigint {
  const product = a * b;
  return (product & mask) ^ (product >> 64n);
}

function avalanche(x: bigint): bigint {
  x ^= x >> 37n;
  x = (x * 0x165667919e3779f9n) & mask;
  return x ^ (x >> 32n);
}

function avalanche64(x: bigint): bigint {
  x ^= x >> 33n;
  x = (x * prime64[2]) & mask;
  x ^= x >> 29n;
  x = (x * prime64[3]) & mask;
  return x ^ (x >> 32n);
}

/** At most 240 bytes. */
function shortHash(bytes: Uint8Array): bigint {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const length = bytes.length;
  const size = BigInt(length);
  const word = (at: number) => BigInt(view.getUint32(at, true));
  const long = (at: number) => view.getBigUint64(at, true);
  const mixed = (at: number, of: number) =>
    foldedProduct(long(at) ^ secretAt(of), long(at + 8) ^ secretAt(of + 8));

  if (length === 0) return avalanche64(secretAt(56) ^ secretAt(64));
  if (length <= 3) {
    const combined =
      ((bytes[0] << 16) | (bytes[length >> 1] << 24) | bytes[length - 1] | (length << 8)) >>> 0;
    return avalanche64(BigInt((combined ^ secretWords[0] ^ secretWords[1]) >>> 0));
  }
  if (length <= 8) {
    let h = (word(length - 4) | (word(0) << 32n)) ^ (secretAt(8) ^ secretAt(16));
    h ^= rotate(h, 49n) ^ rotate(h, 24n);
    h = (h * 0x9fb21c651e98df25n) & mask;
    h ^= (h >> 35n) + size;
    h = (h * 0x9fb21c651e98df25n) & mask;
    return h ^ (h >> 28n);
  }
  if (length <= 16) {
    const low = long(0) ^ (secretAt(24) ^ secretAt(32));
    const high = long(length - 8) ^ (secretAt(40) ^ secretAt(48));
    return avalanche((size + swap64(low) + high + foldedProduct(low, high)) & mask);
  }
  let sum = size * prime64[1];
  if (length <= 128) {
    for (let i = Math.floor((length - 1) / 32); i >= 0; --i)
      sum += mixed(16 * i, 32 * i) + mixed(length - 16 * (i + 1), 32 * i + 16);
    return avalanche(sum & mask);
  }
  for (let i = 0; i < 8; ++i) sum += mixed(16 * i, 16 * i);
  sum = avalanche(sum & mask);
  for (let i = 8; i < Math.floor(length / 16); ++i) sum += mixed(16 * i, 16 * (i - 8) + 3);
  sum += mixed(length - 16, 136 - 17);
  return avalanche(sum & mask);
}

const stripe = 64;
const stripesPerBlock = 16;
const blockBytes = stripe * stripesPerBlock;

/** The state of a long hash: eight 64-bit sums, low half first. */
class LongHash {
  private readonly sums = new Uint32Array(16);

  constructor() {
    const start = [
      prime32[3], prime64[1], prime64[2], prime64[3],
      prime64[4], prime32[2], prime64[5], prime32[1],
    ];
    start.forEach((value, i) => {
      this.sums[2 * i] = Number(value & 0xffffffffn);
      this.sums[2 * i + 1] = Number(value >> 32n);
    });
  }

  /** Adds the stripe at word `at` of `data`; `key` is the word of the secret. */
  addStripe(data: Uint32Array, at: number, keys: Uint32Array, key: number): void {
    const sums = this.sums;
    for (let lane = 0; lane < 16; lane += 2) {
      const low = data[at + lane];
      const high = data[at + lane + 1];
      const a = (low ^ keys[key + lane]) >>> 0;
      const b = (high ^ keys[key + lane + 1]) >>> 0;
      // The 64-bit product of two 32-bit numbers, in halves.
      const aLow = a & 0xffff;
      const aHigh = a >>> 16;
      const bLow = b & 0xffff;
      const bHigh = b >>> 16;
      const middle = aHigh * bLow + aLow * bHigh + ((Math.imul(aLow, bLow) >>> 0) >>> 16);
      const productLow = Math.imul(a, b) >>> 0;
      const productHigh = aHigh * bHigh + Math.floor(middle / 65536);
      const own = sums[lane] + productLow;
      sums[lane] = own;
      sums[lane + 1] = sums[lane + 1] + productHigh + (own > 0xffffffff ? 1 : 0);
      // The data itself goes to the neighbouring sum.
      const other = lane ^ 2;
      const added = sums[other] + low;
      sums[other] = added;
      sums[other + 1] = sums[other + 1] + high + (added > 0xffffffff ? 1 : 0);
    }
  }

  addBlock(data: Uint32Array, at: number): void {
    for (let i = 0; i < stripesPerBlock; ++i) this.addStripe(data, at + 16 * i, secretWords, 2 * i);
    this.scramble();
  }

  private scramble(): void {
    const sums = this.sums;
    const key = (secret.length - stripe) / 4;
    const prime = 0x9e3779b1;
    for (let lane = 0; lane < 16; lane += 2) {
      const low = sums[lane];
      const high = sums[lane + 1];
      // x ^= x >> 47, then the secret.
      const a = (low ^ (high >>> 15) ^ secretWords[key + lane]) >>> 0;
      const b = (high ^ secretWords[key + lane + 1]) >>> 0;
      const aLow = a & 0xffff;
      const aHigh = a >>> 16;
      const primeLow = prime & 0xffff;
      const primeHigh = prime >>> 16;
      const middle =
        aHigh * primeLow + aLow * primeHigh + ((Math.imul(aLow, primeLow) >>> 0) >>> 16);
      sums[lane] = Math.imul(a, prime);
      sums[lane + 1] = aHigh * primeHigh + Math.floor(middle / 65536) + (Math.imul(b, prime) >>> 0);
    }
  }

  digest(length: number): bigint {
    const long = (i: number) =>
      BigInt(this.sums[2 * i]) | (BigInt(this.sums[2 * i + 1]) << 32n);
    let result = BigInt(length) * prime64[1];
    for (let i = 0; i < 4; ++i)
      result += foldedProduct(
        long(2 * i) ^ secretAt(11 + 16 * i),
        long(2 * i + 1) ^ secretAt(11 + 16 * i + 8),
      );
    return avalanche(result & mask);
  }
}

const isLittleEndian = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;

/** Words of bytes; copies them if they are not aligned. */
function wordsOf(bytes: Uint8Array): Uint32Array {
  if (!isLittleEndian) throw new Error("this machine is not little endian");
  if (bytes.byteOffset % 4 !== 0) bytes = bytes.slice();
  return new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
}

/** The hash of more than 240 bytes; yields after every 4 MB. */
function* longHash(bytes: Uint8Array): Generator<void, bigint> {
  const words = wordsOf(bytes);
  const length = bytes.length;
  const hash = new LongHash();
  const blocks = Math.floor((length - 1) / blockBytes);
  for (let i = 0; i < blocks; ++i) {
    hash.addBlock(words, (i * blockBytes) / 4);
    if (i % 4096 === 4095) yield;
  }
  const stripes = Math.floor((length - 1 - blocks * blockBytes) / stripe);
  for (let i = 0; i < stripes; ++i)
    hash.addStripe(words, (blocks * blockBytes + i * stripe) / 4, secretWords, 2 * i);
  // The last 64 bytes, wherever they begin, with a part of the secret that is not aligned either.
  const lastKey = secret.length - stripe - 7;
  hash.addStripe(
    wordsOf(bytes.slice(length - stripe)),
    0,
    wordsOf(secret.slice(lastKey, lastKey + stripe)),
    0,
  );
  return hash.digest(length);
}

/** XXH3-64 of `bytes`. */
export function xxh3(bytes: Uint8Array): bigint {
  if (bytes.length <= 240) return shortHash(bytes);
  const steps = longHash(bytes);
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
  }
}

/** The same, which lets other work run between every 4 MB. */
export async function xxh3InSteps(bytes: Uint8Array): Promise<bigint> {
  if (bytes.length <= 240) return shortHash(bytes);
  const steps = longHash(bytes);
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
    await new Promise((resolve) => setTimeout(resolve));
  }
}
