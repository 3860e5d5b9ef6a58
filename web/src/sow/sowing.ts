import { fail, SwardError } from "../format/error";
import type { Field } from "../format/field";
import { callback, checkOptions, flag, Rule } from "../format/options";
import { patchWord, Patches, patchWords } from "../format/patches";
import type { Vec3 } from "../format/texts";
import { compileSower, numbersOf, SowModule } from "./module";
import type { SowEye } from "./module";
import { sownPageBlades, sownPagePatches } from "./pages";
import type { UnitPages } from "./pages";
import { Sower } from "./sower";
import type { FromSower, SowState, ToSower } from "./sower";
import { sowerName } from "./worker";

/** How a field with seeds is sown. */
export interface SowOptions {
  /** Blades that may be on the device besides the stored ones: 27 bytes each; 4 million by default. */
  blades?: number;
  /** False: the page's own thread sows, between frames. */
  worker?: boolean;
  /** Instead of `sow.wasm` beside this script. */
  wasm?: BufferSource;
  /** Called when something new is to be drawn. */
  onChange?(): void;
  /** Called once, if sowing ends; what is there is still drawn. */
  onError?(error: SwardError): void;
}

export const sowRules: Record<string, Rule> = {
  blades: ["a number of at least 1", (value: unknown) => typeof value === "number" && value >= 1 && value < Infinity],
  worker: flag,
  wasm: ["the bytes of sow.wasm", (value: unknown) => value instanceof ArrayBuffer || ArrayBuffer.isView(value)],
  onChange: callback,
  onError: callback,
};

const usualBlades = 4_000_000;
/** Pages that come in a frame: 6 MB. */
const pagesOfFrame = 192;
/** As in src/render/sowing/sowing.cpp. */
const ignoredStep = 0.2;
const ignoredPart = 0.01;
const maxThinning = 8;
const thinningStep = 1.1;

/** A row of the tables that has changed. */
export interface SownRow {
  /** Place among the pages. */
  page: number;
  /** Four words a blade. */
  blades: Uint32Array;
}

/** A unit on the device: the patch that bounds it, and the patches of its pages. */
interface UnitPlace {
  /** Places among the pages. */
  pages: number[];
  patchCounts: number[];
}

/**
 * The blades that are sown near the eyes of a field with seeds (decision 0045). A sower grows them in a worker; they
 * come into tables behind the stored blades and patches, by pages.
 */
export class Sowing {
  /** All patches: the stored ones with the widths of the whole meadow, then places for those of pages. */
  readonly patches: Patches;
  /** Patches that are stored. */
  readonly storedPatches: number;
  /** First patch and first blade of the first page. */
  readonly firstPatch: number;
  readonly firstBlade: number;
  /** Places for pages. */
  readonly pageCount: number;
  /** Blades of the whole meadow that a stored one stands for, and the leaf area of these over that of the stored one. */
  readonly bladesPerStored: number;
  readonly areaPerStored: number;
  /** Pages whose rows have changed since the last update(). */
  changed: SownRow[] = [];
  private readonly units = new Map<string, UnitPlace>();
  private readonly free: number[] = [];
  private readonly local: SowModule;
  private arrived: { name: string; pages: UnitPages }[] = [];
  private looked: SowEye | undefined;
  private state: SowState = { look: 0, missing: 1, missingScore: maxThinning, isFull: false, blades: 0 };
  private looks = 0;
  private thinned = 0;
  private tell: (message: ToSower) => void = () => {};
  private worker: Worker | undefined;
  private isStopped = false;

  private constructor(
    readonly field: Field,
    private readonly options: SowOptions,
    module: WebAssembly.Module,
  ) {
    const seeds = field.seeds!;
    const { meadow } = seeds;
    this.bladesPerStored = 1 / Math.min(meadow.stored, 1);
    this.areaPerStored = this.bladesPerStored / meadow.storedWidening;
    this.pageCount = Math.max(Math.ceil((options.blades ?? usualBlades) / sownPageBlades), 16);
    this.storedPatches = field.patches.count;
    // Pages of patches begin at whole rows of their texture.
    this.firstPatch = Math.ceil(this.storedPatches / 256) * 256;
    this.firstBlade = Math.ceil(field.bladeCount / sownPageBlades) * sownPageBlades;
    const words = new Uint32Array(patchWords * (this.firstPatch + this.pageCount * sownPagePatches));
    words.set(field.patches.words);
    this.patches = new Patches(new Uint8Array(words.buffer));
    for (let p = 0; p < this.storedPatches; ++p)
      this.patches.floats[patchWords * p + patchWord.widthStep] /= meadow.storedWidening;
    for (let page = this.pageCount; page-- > 0; ) this.free.push(page);
    const numbers = numbersOf(meadow, field.species, field.origin);
    this.local = new SowModule(module, field.name);
    this.local.begin(numbers, new Uint8Array(0));
    this.start();
    this.tell({ kind: "begin", module, numbers, entries: seeds.entries, pages: this.pageCount, place: field.name });
  }

  /** Begins to sow a field, which must have seeds. */
  static async open(field: Field, options: SowOptions = {}): Promise<Sowing> {
    checkOptions("sow", options, sowRules);
    if (!field.isSown) fail("usage", `${field.name}: has no seeds of which some blades are stored`);
    const bytes = options.wasm ?? (await wasmBeside());
    return new Sowing(field, options, await compileSower(bytes, field.name));
  }

  /** Ends its work. */
  stop(): void {
    this.isStopped = true;
    this.worker?.terminate();
    this.tell = () => {};
  }

  /** Factor by which the threshold of level of detail is raised while blades are missing, 1 to 8. */
  get thinning(): number {
    return Math.max(this.thinned, 1);
  }

  /** Whether further frames with this eye change nothing. */
  get isSettled(): boolean {
    return (
      this.looks === this.state.look && this.looks > 0 && this.arrived.length === 0 && (this.state.missing === 0 || this.state.isFull) && this.thinned === this.wantedThinning
    );
  }

  /** Whether the next frame shows something else than the last one. */
  get hasNews(): boolean {
    return this.arrived.length > 0 || this.thinned !== this.wantedThinning;
  }

  /** Blades that are sown now. */
  get bladeCount(): number {
    return this.state.blades;
  }

  /** Distance beyond which less is drawn, for an eye: render::sparseDistance(). `full`: up to which all is drawn [m]. */
  sparseDistance(low: Vec3, high: Vec3, full: number, nearest: number): number {
    const { meadow } = this.field.seeds!;
    let shares = 0;
    let blades = 0;
    for (const kind of meadow.species) {
      shares += kind.share;
      blades += kind.share * (1 + kind.ribbons);
    }
    const perArea = meadow.density * (shares > 0 ? blades / shares : 1);
    const all = this.field.bladeCount * this.bladesPerStored;
    return this.local.sparseDistance(this.pageCount * sownPageBlades, perArea, all, low, high, full, nearest);
  }

  /** Takes over what has come, at most 6 MB, and tells the sower where the eye is. Call once a frame. */
  update(eye: SowEye): void {
    if (!this.looked || hasMoved(this.looked, eye)) {
      this.looked = eye;
      this.tell({ kind: "look", number: ++this.looks, eyes: [eye] });
    }
    let room = pagesOfFrame;
    while (this.arrived.length > 0 && room > 0) {
      const { name, pages } = this.arrived.shift()!;
      this.add(name, pages);
      room -= pages.count;
      this.tell({ kind: "taken" });
    }
    const wanted = this.wantedThinning;
    this.thinned =
      this.thinned === 0 ? wanted : Math.min(Math.max(wanted, this.thinned / thinningStep), this.thinned * thinningStep);
  }

  /** All is sown anew: the device was lost. */
  forget(): void {
    for (const name of [...this.units.keys()]) this.remove(name);
    for (let i = 0; i < this.arrived.length; ++i) this.tell({ kind: "taken" });
    this.arrived = [];
    this.changed = [];
    this.looked = undefined;
    this.tell({ kind: "forget" });
  }

  /** Numbers of the patches of units: `visit` is told the one that bounds a unit, and returns whether it is seen. */
  walk(seesUnit: (whole: number) => boolean, visit: (patch: number) => void): void {
    for (const unit of this.units.values()) {
      if (!seesUnit(this.firstPatch + sownPagePatches * unit.pages[0])) continue;
      unit.pages.forEach((page, i) => {
        const first = this.firstPatch + sownPagePatches * page;
        for (let p = i === 0 ? 1 : 0; p < unit.patchCounts[i]; ++p) visit(first + p);
      });
    }
  }

  private get wantedThinning(): number {
    return Math.min(Math.max(this.state.missingScore, 1), maxThinning);
  }

  private start(): void {
    const hear = (message: FromSower) => {
      if (!this.isStopped) this.hear(message);
    };
    const inPage = () => {
      const sower = new Sower(hear, (step) => setTimeout(step));
      this.tell = (message) => sower.hear(message);
    };
    if (this.options.worker === false || typeof Worker === "undefined") return inPage();
    try {
      this.worker = new Worker(new URL("./sward.js", import.meta.url), { type: "module", name: sowerName });
    } catch {
      // Scripts of other servers make no workers.
      return inPage();
    }
    /** Until the worker has answered: what it has been told. */
    const sent: ToSower[] = [];
    let hasAnswered = false;
    this.tell = (message) => {
      if (!hasAnswered) sent.push(message);
      this.worker!.postMessage(message);
    };
    this.worker.onmessage = (event: MessageEvent<FromSower>) => {
      hasAnswered = true;
      sent.length = 0;
      hear(event.data);
    };
    this.worker.onerror = (event) => {
      event.preventDefault();
      if (hasAnswered) return this.end(new SwardError("runtime", `${this.field.name}: sowing has stopped`));
      // The script does not lie where it seems to: sow here.
      this.worker?.terminate();
      inPage();
      for (const message of sent) this.tell(message);
    };
  }

  private hear(message: FromSower): void {
    switch (message.kind) {
      case "wants":
        this.field.seeds!.frame(message.cell).then(
          (frame) => this.tell({ kind: "cell", cell: message.cell, frame }),
          (error: unknown) => this.end(error),
        );
        break;
      case "unit":
        this.arrived.push(message);
        this.options.onChange?.();
        break;
      case "gone":
        for (const name of message.names) {
          // It may not have been taken over yet.
          const at = this.arrived.findIndex((one) => one.name === name);
          if (at >= 0) {
            this.arrived.splice(at, 1);
            this.tell({ kind: "taken" });
          } else {
            this.remove(name);
          }
        }
        break;
      case "state": {
        const before = this.wantedThinning;
        this.state = message.state;
        if (this.wantedThinning !== before) this.options.onChange?.();
        break;
      }
      case "failed":
        this.end(new SwardError(message.error, message.message));
    }
  }

  private end(error: unknown): void {
    if (this.isStopped) return;
    this.stop();
    this.state = { ...this.state, look: this.looks, missing: 0, missingScore: 0 };
    this.options.onError?.(error instanceof SwardError ? error : new SwardError("runtime", String(error)));
  }

  private add(name: string, unit: UnitPages): void {
    const pages = Array.from({ length: unit.count }, () => this.free.pop()!);
    const words = sownPageBlades * 4;
    pages.forEach((page, i) => {
      const first = this.firstPatch + sownPagePatches * page;
      const own = unit.patches.subarray(i * sownPagePatches * patchWords, (i + 1) * sownPagePatches * patchWords);
      this.patches.words.set(own, patchWords * first);
      for (let p = 0; p < unit.patchCounts[i]; ++p)
        this.patches.words[patchWords * (first + p) + patchWord.firstBlade] += this.firstBlade + sownPageBlades * page;
      this.changed.push({ page, blades: unit.blades.subarray(i * words, (i + 1) * words) });
    });
    this.units.set(name, { pages, patchCounts: unit.patchCounts });
  }

  private remove(name: string): void {
    const unit = this.units.get(name);
    if (!unit) return;
    this.units.delete(name);
    this.free.push(...unit.pages);
    const gone = new Set(unit.pages);
    this.changed = this.changed.filter((row) => !gone.has(row.page));
  }
}

/** Whether an eye may want other units than before. */
function hasMoved(a: SowEye, b: SowEye): boolean {
  const step = Math.hypot(a.eye[0] - b.eye[0], a.eye[1] - b.eye[1], a.eye[2] - b.eye[2]);
  const changed = (x: number, y: number) => Math.abs(x - y) > ignoredPart * Math.abs(y);
  return (
    step >= ignoredStep || changed(a.pixelsPerUnit, b.pixelsPerUnit) || changed(a.lodThreshold, b.lodThreshold) ||
    a.lodWidth !== b.lodWidth || a.drawDistance !== b.drawDistance || changed(a.sparseFrom, b.sparseFrom)
  );
}

async function wasmBeside(): Promise<ArrayBuffer> {
  const address = new URL("./sow.wasm", import.meta.url);
  let response: Response;
  try {
    response = await fetch(address);
  } catch {
    fail("io", `${address}: no answer from the server`);
  }
  if (!response.ok) fail("io", `${address}: the server answers ${response.status}`);
  return response.arrayBuffer();
}
