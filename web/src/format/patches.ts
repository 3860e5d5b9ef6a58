import { fail } from "./error";

/** Words of a patch (docs/field_format.md): where each field begins, in words of 4 bytes. */
export const patchWord = {
  boundsLow: 0, firstBlade: 3, boundsHigh: 4, bladeCount: 7, rootLow: 8, rootStep: 11,
  coneAxis: 12, coneCosine: 15, heightLow: 16, heightStep: 17, widthLow: 18, widthStep: 19,
  parent: 20, firstChild: 21, childCount: 22, level: 23, rankLow: 24, rankHigh: 25,
} as const;

/** Words of one patch. */
export const patchWords = 26;

const noPatch = 0xffffffff;
const maxPatchBlades = 512;

/** The patch tree: all patches, level by level, as two views of the same memory. */
export class Patches {
  readonly floats: Float32Array;
  readonly words: Uint32Array;
  readonly count: number;

  /** `bytes`: the chunk PATCHES, at a multiple of 4 in its buffer. */
  constructor(bytes: Uint8Array) {
    this.count = bytes.length / (4 * patchWords);
    this.floats = new Float32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords);
    this.words = new Uint32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords);
  }

  firstBlade(patch: number): number {
    return this.words[patch * patchWords + patchWord.firstBlade];
  }

  bladeCount(patch: number): number {
    return this.words[patch * patchWords + patchWord.bladeCount];
  }

  firstChild(patch: number): number {
    return this.words[patch * patchWords + patchWord.firstChild];
  }

  childCount(patch: number): number {
    return this.words[patch * patchWords + patchWord.childCount];
  }

  parent(patch: number): number {
    return this.words[patch * patchWords + patchWord.parent];
  }

  /** The patch that owns a blade. */
  patchOf(blade: number): number {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.firstBlade(middle) <= blade) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Checks what docs/field_format.md says of the tree and of its numbers. */
  verify(blades: number, place: string): void {
    let nextBlade = 0;
    let nextChild = 1;
    const w = this.words;
    for (let p = 0; p < this.count; ++p) {
      const at = p * patchWords;
      this.verifyNumbers(p, place);
      if (this.firstBlade(p) !== nextBlade)
        fail("input", `${place}: patch ${p} begins at blade ${this.firstBlade(p)} instead of ${nextBlade}`);
      nextBlade += this.bladeCount(p);
      const parent = this.parent(p);
      const level = w[at + patchWord.level];
      if (p === 0 ? parent !== noPatch || level !== 0 : parent >= p)
        fail("input", `${place}: patch ${p} has the parent ${parent}`);
      const children = this.childCount(p);
      if (children > 8) fail("input", `${place}: patch ${p} has ${children} children, more than 8`);
      if (this.firstChild(p) !== (children === 0 ? noPatch : nextChild))
        fail("input", `${place}: patch ${p} has its children at ${this.firstChild(p)}`);
      nextChild += children;
      if (p === 0) continue;
      const first = this.firstChild(parent);
      if (p < first || p - first >= this.childCount(parent))
        fail("input", `${place}: patch ${p} is not a child of its parent ${parent}`);
      if (level !== w[parent * patchWords + patchWord.level] + 1)
        fail("input", `${place}: patch ${p} has level ${level}`);
    }
    if (nextBlade !== blades)
      fail("input", `${place}: the patches own ${nextBlade} blades, of ${blades} that there are`);
    if (this.count > 0 && nextChild !== this.count)
      fail("input", `${place}: ${nextChild} patches are reached from the root, of ${this.count} that there are`);
  }

  private verifyNumbers(p: number, place: string): void {
    const at = p * patchWords;
    const f = this.floats;
    const isFinite3 = (word: number) =>
      Number.isFinite(f[at + word]) && Number.isFinite(f[at + word + 1]) && Number.isFinite(f[at + word + 2]);
    const { boundsLow, boundsHigh, coneAxis } = patchWord;
    if (
      !isFinite3(boundsLow) ||
      !isFinite3(boundsHigh) ||
      [0, 1, 2].some((axis) => f[at + boundsLow + axis] > f[at + boundsHigh + axis])
    )
      fail("input", `${place}: patch ${p} has no valid bounds`);
    for (const key of ["rootStep", "heightLow", "heightStep", "widthLow", "widthStep"] as const) {
      const step = f[at + patchWord[key]];
      if (!Number.isFinite(step) || step < 0)
        fail("input", `${place}: patch ${p} has the quantisation step ${step}`);
    }
    if (!isFinite3(patchWord.rootLow))
      fail("input", `${place}: patch ${p} has a root that is not finite`);
    const axis = Math.hypot(f[at + coneAxis], f[at + coneAxis + 1], f[at + coneAxis + 2]);
    const cosine = f[at + patchWord.coneCosine];
    if (!(Math.abs(axis - 1) <= 1e-3) || !(cosine >= -1 && cosine <= 1))
      fail("input", `${place}: patch ${p} has no valid normal cone`);
    const low = f[at + patchWord.rankLow];
    const high = f[at + patchWord.rankHigh];
    if (!(low >= 0 && low <= high && high <= 1))
      fail("input", `${place}: patch ${p} has ranks ${low} to ${high}, outside 0 to 1`);
    if (this.bladeCount(p) > maxPatchBlades)
      fail("input", `${place}: patch ${p} owns ${this.bladeCount(p)} blades, more than ${maxPatchBlades}`);
  }
}
