import { patchWord, patchWords } from "../format/patches";
import type { GrownUnit } from "./module";

/** Places of blades that come and go together: a row of the textures of blades and states. */
export const sownPageBlades = 2048;
/** Places of patches of a page. */
export const sownPagePatches = 64;

const bladeWords = 4;
const noPatch = 0xffffffff;

/** The blades of a unit, cut into pages. A patch lies in one page. */
export interface UnitPages {
  /** Pages; the last words of each may be 0. */
  count: number;
  /** sownPageBlades · 4 words a page. */
  blades: Uint32Array;
  /** sownPagePatches · 26 words a page: bounds of the unit in the first one of all, then patches; their first blade counts from their page. */
  patches: Uint32Array;
  /** Patches in each page, from its first place on. */
  patchCounts: number[];
  /** Blades of all. */
  bladeCount: number;
}

/** Cuts a unit into pages. */
export function pagesOf(unit: GrownUnit): UnitPages {
  const all = unit.patches.length / patchWords;
  const pages: { first: number; end: number; blades: number }[] = [];
  let current = { first: 0, end: 0, blades: 0 };
  // The bounds of the unit take the first place.
  let room = sownPagePatches - 1;
  for (let p = 0; p < all; ++p) {
    const count = unit.patches[patchWords * p + patchWord.bladeCount];
    if (room === 0 || current.blades + count > sownPageBlades) {
      pages.push(current);
      current = { first: p, end: p, blades: 0 };
      room = sownPagePatches;
    }
    current.end = p + 1;
    current.blades += count;
    --room;
  }
  if (all > 0) pages.push(current);
  const result: UnitPages = {
    count: pages.length,
    blades: new Uint32Array(pages.length * sownPageBlades * bladeWords),
    patches: new Uint32Array(pages.length * sownPagePatches * patchWords),
    patchCounts: [],
    bladeCount: unit.blades.length / bladeWords,
  };
  pages.forEach(({ first, end }, i) => {
    const shift = i === 0 ? 1 : 0;
    const at = patchWords * (sownPagePatches * i + shift);
    result.patches.set(unit.patches.subarray(patchWords * first, patchWords * end), at);
    const from = unit.patches[patchWords * first + patchWord.firstBlade];
    for (let p = 0; p < end - first; ++p) {
      const word = at + patchWords * p + patchWord.firstBlade;
      result.patches[word] -= from;
    }
    const last = patchWords * (end - 1);
    const to = unit.patches[last + patchWord.firstBlade] + unit.patches[last + patchWord.bladeCount];
    result.blades.set(unit.blades.subarray(bladeWords * from, bladeWords * to), bladeWords * sownPageBlades * i);
    result.patchCounts.push(end - first + shift);
  });
  if (pages.length > 0) {
    result.patches.set(unit.whole);
    result.patches[patchWord.bladeCount] = 0;
    result.patches[patchWord.firstChild] = noPatch;
    // What a walk needs of the unit: how wide its blades are.
    new Float32Array(result.patches.buffer)[patchWord.widthLow] = unit.widest;
    new Float32Array(result.patches.buffer)[patchWord.widthStep] = 0;
  }
  return result;
}
