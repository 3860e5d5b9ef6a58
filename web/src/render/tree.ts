import { bladeShadowSegments, lodFullShare, maxHeightCompensation, outlineMost } from "../generated/layout";
import { Patches, patchWord, patchWords } from "../format/patches";
import { Field } from "../format/field";
import { ribbonsOf } from "../format/texts";
import type { Sowing } from "../sow/sowing";

/** What culling knows of a view: the members of Eyepoint in shaders/shared/eyepoint.h. */
export interface TreeView {
  eye: readonly number[];
  planes: readonly (readonly number[])[];
  drawDistance: number;
  pixelsPerUnit: number;
  lodThreshold: number;
  lodWidth: number;
  minWidth: number;
  /** [m] beyond this distance less is drawn; 0: off. And the least share that is left. */
  sparseFrom: number;
  sparseLeast: number;
}

/** Blades of one instance of the passes that move and pose them: groupBlades in web/shaders/blades.glsl. */
export const groupBlades = 32;

/** Rows of segments that ribbons of a class may have, and above how many pixels of height; the nearest first. */
export const classes = [
  { segments: 16, above: 120, columns: 3 },
  { segments: 8, above: 26, columns: 3 },
  { segments: 4, above: 5, columns: 2 },
  { segments: 2, above: -1, columns: 2 },
  { segments: bladeShadowSegments, above: Infinity, columns: 2 },
];

/** The class of blades that only cast shadows. */
export const shadowClass = 4;

/** Groups of blades to draw, by class: patch, number of the first blade in the patch, blades. */
export interface Groups {
  words: Uint32Array;
  /** Where the groups of each class begin, and the end. */
  begins: number[];
  /** Blades in them. */
  blades: number;
  /** Pages that are missing, the most wanted first. */
  missing: number[];
}

/** The share of blades that level of detail draws of a width in pixels: lodShare() of shaders/shared/culling.h. */
const lodShare = (pixels: number, threshold: number) =>
  Math.min(Math.max(pixels / threshold, 1 / 256), lodFullShare);

/** sparseShare() and leavesPerDrawn() of shaders/shared/visibility.h. */
function sparseShare(view: TreeView, share: number, distance: number): number {
  if (view.sparseFrom <= 0 || distance <= view.sparseFrom) return 1;
  return Math.max((view.sparseFrom / distance) ** 3, Math.min(view.sparseLeast / share, 1));
}

/** The walk of the patch tree: patchCulled() and thickEnough() of shaders/shared/visibility.h, on the CPU. */
export class PatchTree {
  /** Largest full width of a blade in each subtree [m]. */
  private readonly widest: Float32Array;
  /** The lowest rank below each node; 1 if there is none. */
  private readonly rankBelow: Float32Array;
  private readonly queue: Uint32Array;
  private readonly patches: Patches;
  /** Ribbons of a plant at most. */
  private readonly ribbons: number;

  /** `sowing`: of a field that is sown; its patches stand for those of the field. */
  constructor(
    private readonly field: Field,
    private readonly sowing?: Sowing,
  ) {
    const patches = (this.patches = sowing?.patches ?? field.patches);
    const stored = field.patches.count;
    this.ribbons = Math.max(0, ...field.species.map((one) => ribbonsOf(one.organs)));
    this.widest = subtreeWidths(patches, stored);
    this.rankBelow = new Float32Array(stored).fill(1);
    this.queue = new Uint32Array(stored);
    const f = patches.floats;
    for (let p = stored - 1; p >= 0; --p) {
      const at = p * patchWords;
      if (p === 0) continue;
      const parent = patches.parent(p);
      const rank = patches.bladeCount(p) > 0 ? f[at + patchWord.rankLow] : 1;
      this.rankBelow[parent] = Math.min(this.rankBelow[parent], rank, this.rankBelow[p]);
    }
  }

  /** Distance [m] of the eye from a patch's box. */
  private distance(view: TreeView, at: number): number {
    const f = this.patches.floats;
    let square = 0;
    for (let i = 0; i < 3; ++i) {
      const off = Math.max(
        f[at + patchWord.boundsLow + i] - view.eye[i],
        view.eye[i] - f[at + patchWord.boundsHigh + i],
        0,
      );
      square += off * off;
    }
    return Math.sqrt(square);
  }

  private shareAt(view: TreeView, distance: number): number {
    if (view.lodThreshold <= 0) return lodFullShare;
    const share = lodShare((view.lodWidth * view.pixelsPerUnit) / Math.max(distance, 1e-6), view.lodThreshold);
    return share * sparseShare(view, share, distance);
  }

  private leavesPerDrawn(view: TreeView, distance: number): number {
    if (view.sparseFrom <= 0 || distance <= view.sparseFrom || view.lodThreshold <= 0) return 1;
    const share = lodShare((view.lodWidth * view.pixelsPerUnit) / Math.max(distance, 1e-6), view.lodThreshold);
    return 1 / Math.sqrt(sparseShare(view, share, distance));
  }

  /** Whether no blade of a subtree is in the view. */
  private isOutside(view: TreeView, p: number, nearest: number, widest: number): boolean {
    if (nearest > view.drawDistance) return true;
    const f = this.patches.floats;
    const at = p * patchWords;
    let square = 0;
    let thinnest = Infinity;
    for (let i = 0; i < 3; ++i) {
      const low = f[at + patchWord.boundsLow + i];
      const high = f[at + patchWord.boundsHigh + i];
      const far = Math.max(Math.abs(low - view.eye[i]), Math.abs(high - view.eye[i]));
      square += far * far;
      thinnest = Math.min(thinnest, high - low);
    }
    const farthest = Math.sqrt(square);
    const margin =
      (0.5 * outlineMost * widest) / (0.95 * this.shareAt(view, farthest) * this.leavesPerDrawn(view, farthest)) +
      view.minWidth * farthest +
      (maxHeightCompensation - 1) * 0.5 * thinnest;
    for (const plane of view.planes) {
      let sum = plane[3];
      for (let i = 0; i < 3; ++i)
        sum +=
          plane[i] *
          (plane[i] >= 0 ? f[at + patchWord.boundsHigh + i] + margin : f[at + patchWord.boundsLow + i] - margin);
      if (sum < 0) return true;
    }
    return false;
  }

  /** The groups of blades that a view may show. `most`: blades at most. */
  groupsOf(view: TreeView, most: number, oneClass = -1): Groups {
    const { patches, sowing } = this;
    const f = patches.floats;
    const seen: { patch: number; count: number; distance: number }[] = [];
    const wanted: { page: number; distance: number }[] = [];
    let blades = 0;
    /** Adds the blades of a patch that are drawn at a share. */
    const add = (p: number, share: number, nearest: number, isStored: boolean) => {
      const at = p * patchWords;
      const own = patches.bladeCount(p);
      const low = f[at + patchWord.rankLow];
      const high = f[at + patchWord.rankHigh];
      if (own === 0 || share <= low) return;
      const thick = share >= high ? own : Math.ceil(((share - low) / (high - low)) * own) + 1;
      // The ribbons of the last plant, too.
      const count = Math.min(thick + this.ribbons, own);
      const begin = patches.firstBlade(p);
      if (isStored && !this.field.has(begin, count)) {
        for (const page of pagesOf(begin, count))
          if (this.field.isMissing(page)) wanted.push({ page, distance: nearest * (1 + low) });
        return;
      }
      if (blades + count > most) return;
      blades += count;
      seen.push({ patch: p, count, distance: nearest });
    };
    let end = 0;
    if (this.field.patches.count > 0) this.queue[end++] = 0;
    for (let next = 0; next < end; ++next) {
      const p = this.queue[next];
      const nearest = this.distance(view, p * patchWords);
      if (this.isOutside(view, p, nearest, this.widest[p])) continue;
      const share = this.shareAt(view, nearest);
      if (share > this.rankBelow[p]) {
        const first = patches.firstChild(p);
        for (let i = 0; i < patches.childCount(p); ++i) this.queue[end++] = first + i;
      }
      add(p, share, nearest, true);
    }
    const widestOf = (p: number) =>
      f[p * patchWords + patchWord.widthLow] + 63 * f[p * patchWords + patchWord.widthStep];
    sowing?.walk(
      (whole) => !this.isOutside(view, whole, this.distance(view, whole * patchWords), widestOf(whole)),
      (p) => {
        const nearest = this.distance(view, p * patchWords);
        const share = this.shareAt(view, nearest);
        if (share <= f[p * patchWords + patchWord.rankLow]) return;
        if (!this.isOutside(view, p, nearest, widestOf(p))) add(p, share, nearest, false);
      },
    );
    // Near blades first: what they hide is not lit.
    seen.sort((a, b) => a.distance - b.distance);
    const lists: number[][] = classes.map(() => []);
    for (const { patch, count, distance } of seen) {
      const at = patch * patchWords;
      const height = f[at + patchWord.heightLow] + 255 * f[at + patchWord.heightStep];
      const pixels = (height * view.pixelsPerUnit) / Math.max(distance, 1e-6);
      const kind = oneClass >= 0 ? oneClass : classes.findIndex((one) => pixels > one.above);
      for (let i = 0; i < count; i += groupBlades) lists[kind].push(patch, i, Math.min(groupBlades, count - i));
    }
    const begins = [0];
    for (const list of lists) begins.push(begins[begins.length - 1] + list.length / 3);
    const words = new Uint32Array(3 * begins[classes.length]);
    lists.forEach((list, i) => words.set(list, 3 * begins[i]));
    wanted.sort((a, b) => a.distance - b.distance);
    return { words, begins, blades, missing: [...new Set(wanted.map((one) => one.page))] };
  }
}

/** Largest full width of a blade in each of the first subtrees [m]: Subtree::widest of shaders/shared/patch_tree.h. */
export function subtreeWidths(patches: Patches, count = patches.count): Float32Array {
  const f = patches.floats;
  const widest = new Float32Array(count);
  for (let p = count - 1; p >= 0; --p) {
    const at = p * patchWords;
    const own = patches.bladeCount(p) > 0 ? f[at + patchWord.widthLow] + 63 * f[at + patchWord.widthStep] : 0;
    widest[p] = Math.max(widest[p], own);
    if (p > 0) widest[patches.parent(p)] = Math.max(widest[patches.parent(p)], widest[p]);
  }
  return widest;
}

const pageBlades = 1024;

function* pagesOf(first: number, count: number): Generator<number> {
  for (let p = Math.floor(first / pageBlades); p <= Math.floor((first + count - 1) / pageBlades); ++p) yield p;
}

/** Mean width of a field's blades [m], from the middle of each patch's range. */
export function meanBladeWidth(patches: Patches, patchCount = patches.count): number {
  const f = patches.floats;
  let width = 0;
  let count = 0;
  for (let p = 0; p < patchCount; ++p) {
    const own = patches.bladeCount(p);
    width += own * (f[p * patchWords + patchWord.widthLow] + 31.5 * f[p * patchWords + patchWord.widthStep]);
    count += own;
  }
  return count > 0 ? width / count : 0.01;
}
