import { unpackFrame } from "../format/container";
import { SwardError } from "../format/error";
import type { ErrorKind } from "../format/error";
import { SowModule } from "./module";
import type { SowEye, SowUnit, WantedUnit } from "./module";
import { pagesOf } from "./pages";
import type { UnitPages } from "./pages";

/** What a page tells its sower. */
export type ToSower =
  | { kind: "begin"; module: WebAssembly.Module; numbers: Float64Array; entries: Uint8Array; pages: number; place: string }
  /** The zstd frame of a cell that the sower has asked for. */
  | { kind: "cell"; cell: number; frame: Uint8Array }
  /** `number` counts these messages. */
  | { kind: "look"; number: number; eyes: SowEye[] }
  /** A unit has been taken over. */
  | { kind: "taken" }
  /** Nothing is on the device any more. */
  | { kind: "forget" };

/** What a sower tells its page. */
export type FromSower =
  | { kind: "wants"; cell: number }
  | { kind: "unit"; name: string; unit: SowUnit; pages: UnitPages }
  | { kind: "gone"; names: string[] }
  | { kind: "state"; state: SowState }
  | { kind: "failed"; error: ErrorKind; message: string };

/** How far a sower is. */
export interface SowState {
  /** Number of the eyes that it has last heard of. */
  look: number;
  /** The highest score of what is wanted and not grown; 0: all is there. */
  missingScore: number;
  /** Wanted units and cells that are not there. */
  missing: number;
  /** Whether what is missing has no room. */
  isFull: boolean;
  /** Blades that are there. */
  blades: number;
}

/** A unit replaces another one that is wanted less by this factor, so that a still eye changes nothing. */
const replacing = 1.19;
/** Units on their way to the page at once. */
const unitsAtOnce = 16;
/** Cells that are asked for at once, and that are open. */
const cellsAtOnce = 4;
const maxOpenCells = 96;

interface Present {
  unit: SowUnit;
  score: number;
  pages: number;
  blades: number;
}

export const unitName = (unit: SowUnit): string => [unit.cell, unit.level, unit.half, ...unit.place].join();

/**
 * Grows what eyes want, the most wanted first, within a room of pages; what is wanted less makes room. Runs in a
 * worker, or step by step in the page.
 */
export class Sower {
  private module: SowModule | undefined;
  private room = 0;
  private used = 0;
  private blades = 0;
  private place = "";
  private readonly present = new Map<string, Present>();
  private wanted: WantedUnit[] = [];
  private next = 0;
  private flying = 0;
  /** Open cells, the last used one at the end. */
  private readonly open = new Set<number>();
  private readonly asked = new Set<number>();
  private isFull = false;
  private isBusy = false;
  private hasFailed = false;
  private lookNumber = 0;

  /** `later` runs a step once other messages have been heard. */
  constructor(
    private readonly tell: (message: FromSower, moved: ArrayBuffer[]) => void,
    private readonly later: (step: () => void) => void,
  ) {}

  hear(message: ToSower): void {
    try {
      this.take(message);
      this.wake();
    } catch (error) {
      this.failWith(error);
    }
  }

  private take(message: ToSower): void {
    switch (message.kind) {
      case "begin":
        this.place = message.place;
        this.room = message.pages;
        this.module = new SowModule(message.module, message.place);
        this.module.begin(message.numbers, message.entries);
        break;
      case "cell":
        this.asked.delete(message.cell);
        this.module!.openCell(message.cell, unpackFrame(message.frame, undefined, `${this.place}: seeds of cell ${message.cell}`));
        this.open.add(message.cell);
        if (this.open.size > maxOpenCells) {
          const oldest = this.open.values().next().value!;
          this.open.delete(oldest);
          this.module!.closeCell(oldest);
        }
        this.choose();
        break;
      case "look":
        this.lookNumber = message.number;
        this.module!.look(message.eyes);
        for (const one of this.present.values()) one.score = this.module!.score(one.unit);
        this.choose();
        break;
      case "taken":
        --this.flying;
        break;
      case "forget":
        this.present.clear();
        this.used = this.blades = 0;
        this.choose();
    }
  }

  private choose(): void {
    this.wanted = this.module!.find();
    this.next = 0;
    this.isFull = false;
  }

  private wake(): void {
    if (this.isBusy || this.hasFailed || !this.module) return;
    this.isBusy = true;
    this.later(() => {
      this.isBusy = false;
      try {
        if (this.step()) this.wake();
      } catch (error) {
        this.failWith(error);
      }
    });
  }

  private failWith(error: unknown): void {
    this.hasFailed = true;
    if (!(error instanceof SwardError)) throw error;
    this.tell({ kind: "failed", error: error.kind, message: error.message }, []);
  }

  /** Grows one unit, or asks for cells. Whether there is more to do now. */
  private step(): boolean {
    let ready = false;
    for (; this.next < this.wanted.length && !this.isFull; ++this.next) {
      const one = this.wanted[this.next];
      if (!one.isCell && this.present.has(unitName(one))) continue;
      if (one.isCell || !this.open.has(one.cell)) {
        // What follows is wanted less, but a cell takes time to come.
        if (!this.ask(one.cell)) break;
        continue;
      }
      if (this.flying >= unitsAtOnce) break;
      this.bring(one);
      ready = true;
      break;
    }
    this.report();
    return ready;
  }

  /** Asks for a cell. Whether more may be asked for. */
  private ask(cell: number): boolean {
    if (this.asked.has(cell)) return true;
    if (this.asked.size >= cellsAtOnce) return false;
    this.asked.add(cell);
    this.tell({ kind: "wants", cell }, []);
    return true;
  }

  private bring(one: WantedUnit): void {
    const unit: SowUnit = { cell: one.cell, level: one.level, half: one.half, place: one.place };
    // This cell has been used last.
    this.open.delete(one.cell);
    this.open.add(one.cell);
    const pages = pagesOf(this.module!.grow(unit));
    if (!this.makeRoom(pages.count, one.score)) {
      this.isFull = true;
      return;
    }
    const name = unitName(unit);
    this.present.set(name, { unit, score: one.score, pages: pages.count, blades: pages.bladeCount });
    if (pages.count === 0) return;
    this.used += pages.count;
    this.blades += pages.bladeCount;
    ++this.flying;
    const moved = [pages.blades.buffer, pages.patches.buffer] as ArrayBuffer[];
    this.tell({ kind: "unit", name, unit, pages }, moved);
  }

  /** Removes units that are wanted less than `score` until so many pages are free. Whether they are. */
  private makeRoom(pages: number, score: number): boolean {
    const names: string[] = [];
    if (this.room - this.used < pages) {
      const least = [...this.present]
        .filter(([, one]) => one.pages > 0 && one.score * replacing < score)
        .sort(([, a], [, b]) => a.score - b.score);
      let free = this.room - this.used;
      for (const [name, one] of least) {
        if (free >= pages) break;
        free += one.pages;
        names.push(name);
      }
      if (free < pages) return false;
    }
    for (const name of names) {
      const one = this.present.get(name)!;
      this.used -= one.pages;
      this.blades -= one.blades;
      this.present.delete(name);
    }
    if (names.length > 0) this.tell({ kind: "gone", names }, []);
    return true;
  }

  private report(): void {
    let missing = 0;
    let missingScore = 0;
    for (const one of this.wanted)
      if (one.isCell || !this.present.has(unitName(one))) {
        ++missing;
        missingScore = Math.max(missingScore, one.score);
      }
    this.tell({ kind: "state", state: { look: this.lookNumber, missing, missingScore, isFull: this.isFull, blades: this.blades } }, []);
  }
}
