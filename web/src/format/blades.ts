import { fail } from "./error";
import { Patches, patchWord, patchWords } from "./patches";
import { ribbonsOf, Species } from "./texts";

/** Words of a packed blade. */
export const bladeWords = 4;

/** Unpacked blades, an array for each property. Positions are relative to the field's origin [m]. */
export interface BladeArrays {
  /** Number of the first blade in the file. */
  readonly first: number;
  readonly count: number;
  /** Root, three numbers a blade. */
  readonly root: Float32Array;
  /** Unit direction of growth, three numbers a blade. */
  readonly up: Float32Array;
  /** Turn of the width axis about `up` [rad]. */
  readonly facing: Float32Array;
  /** [m] */
  readonly height: Float32Array;
  /** Full width at the root [m]. */
  readonly width: Float32Array;
  /** [0, 1] */
  readonly stiffness: Float32Array;
  /** Index into the field's species. */
  readonly species: Uint8Array;
  /** Share of open sky [0, 1]. */
  readonly exposure: Float32Array;
  /** Colour of the ground, sRGB in [0, 1], three numbers a blade. */
  readonly tint: Float32Array;
  /** Clump; of a species with organs: number of the ribbon on its stalk. */
  readonly clump: Uint8Array;
  /** Four random bits. */
  readonly hash: Uint8Array;
  /** Patch that owns the blade. */
  readonly patch: Uint32Array;
}

const twoPi = Math.fround(6.28318530717958647692);

/** Unpacks blades `first` to `first + count − 1`. `packed`: four words a blade, from blade 0. */
export function unpackBlades(
  packed: Uint32Array,
  patches: Patches,
  first: number,
  count: number,
): BladeArrays {
  const blades: BladeArrays = {
    first,
    count,
    root: new Float32Array(3 * count),
    up: new Float32Array(3 * count),
    facing: new Float32Array(count),
    height: new Float32Array(count),
    width: new Float32Array(count),
    stiffness: new Float32Array(count),
    species: new Uint8Array(count),
    exposure: new Float32Array(count),
    tint: new Float32Array(3 * count),
    clump: new Uint8Array(count),
    hash: new Uint8Array(count),
    patch: new Uint32Array(count),
  };
  const single = Math.fround;
  const f = patches.floats;
  let patch = count > 0 ? patches.patchOf(first) : 0;
  for (let i = 0; i < count; ++i) {
    const blade = first + i;
    while (blade >= patches.firstBlade(patch) + patches.bladeCount(patch)) ++patch;
    const at = patch * patchWords;
    const rootXY = packed[bladeWords * blade];
    const rootZUp = packed[bladeWords * blade + 1];
    const shape = packed[bladeWords * blade + 2];
    const look = packed[bladeWords * blade + 3];
    const step = f[at + patchWord.rootStep];
    const places = [rootXY & 65535, rootXY >>> 16, rootZUp & 65535];
    for (let axis = 0; axis < 3; ++axis)
      blades.root[3 * i + axis] = f[at + patchWord.rootLow + axis] + single(step * places[axis]);
    unfoldUp(rootZUp >>> 16, blades.up, 3 * i);
    blades.facing[i] = (shape & 255) * single(twoPi / 256);
    blades.height[i] =
      f[at + patchWord.heightLow] + single(f[at + patchWord.heightStep] * ((shape >>> 8) & 255));
    blades.width[i] =
      f[at + patchWord.widthLow] + single(f[at + patchWord.widthStep] * ((shape >>> 16) & 63));
    blades.stiffness[i] = ((shape >>> 22) & 63) / 63;
    blades.hash[i] = shape >>> 28;
    blades.tint[3 * i] = (look & 31) / 31;
    blades.tint[3 * i + 1] = ((look >>> 5) & 63) / 63;
    blades.tint[3 * i + 2] = ((look >>> 11) & 31) / 31;
    blades.exposure[i] = ((look >>> 16) & 31) / 31;
    blades.species[i] = (look >>> 21) & 7;
    blades.clump[i] = look >>> 24;
    blades.patch[i] = patch;
  }
  return blades;
}

/** The unit vector of an octahedral up-vector. */
function unfoldUp(bits: number, up: Float32Array, at: number): void {
  let x = ((bits & 255) - 127) / 127;
  let y = ((bits >>> 8) - 127) / 127;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const folded = (1 - Math.abs(y)) * (x >= 0 ? 1 : -1);
    y = (1 - Math.abs(x)) * (y >= 0 ? 1 : -1);
    x = folded;
  }
  const size = Math.hypot(x, y, z);
  up[at] = x / size;
  up[at + 1] = y / size;
  up[at + 2] = z / size;
}

/** The number in the CSV export's column `id`, from the chunk KEYS; two words a blade. */
export function bladeId(keys: Uint32Array, blade: number): bigint {
  if (keys.length === 0) return BigInt(blade);
  const mask = 0xffffffffffffffffn;
  let x = (BigInt(keys[2 * blade]) << 32n) | BigInt(keys[2 * blade + 1]);
  x = (x + 0x9e3779b97f4a7c15n) & mask;
  x = ((x ^ (x >> 30n)) * 0xbf58476d1ce4e5b9n) & mask;
  x = ((x ^ (x >> 27n)) * 0x94d049bb133111ebn) & mask;
  return (x ^ (x >> 31n)) >> 11n;
}

const widthBits = 63 << 16;
const clumpBits = 255 << 24;

/**
 * Checks blades `first` to `first + count − 1`: their species, and that each ribbon of a compound plant follows its
 * stalk in the same patch, with the stalk's data. If `first` is inside a plant, the ribbon there is not checked.
 */
export function verifyBlades(
  packed: Uint32Array,
  patches: Patches,
  species: readonly Species[],
  first: number,
  count: number,
  place: string,
): void {
  const ribbons = species.map((one) => ribbonsOf(one.organs));
  const hasPlants = ribbons.some((n) => n > 0);
  let patch = hasPlants && count > 0 ? patches.patchOf(first) : 0;
  for (let blade = first; blade < first + count; ++blade) {
    const at = bladeWords * blade;
    const kind = (packed[at + 3] >>> 21) & 7;
    if (kind >= species.length)
      fail("input", `${place}: blade ${blade} has species ${kind}; there are ${species.length}`);
    if (!hasPlants) continue;
    while (blade >= patches.firstBlade(patch) + patches.bladeCount(patch)) ++patch;
    const number = packed[at + 3] >>> 24;
    if (number === 0 || ribbons[kind] === 0) continue;
    if (number > ribbons[kind])
      fail("input", `${place}: blade ${blade} is ribbon ${number} of a plant with ${ribbons[kind]}`);
    const isFirst = blade === patches.firstBlade(patch);
    if (blade === first && !isFirst) continue;
    if (
      isFirst ||
      packed[at - 1] >>> 24 !== number - 1 ||
      packed[at - 4] !== packed[at] ||
      packed[at - 3] !== packed[at + 1] ||
      ((packed[at - 2] ^ packed[at + 2]) & ~widthBits) !== 0 ||
      ((packed[at - 1] ^ packed[at + 3]) & ~clumpBits) !== 0
    )
      fail("input", `${place}: blade ${blade} is ribbon ${number} without its stalk`);
  }
}
