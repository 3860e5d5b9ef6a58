/** Contexts of WebGL that a page has before those of far elements are given away. */
const fewContexts = 8;
/** Contexts that a page may have: browsers keep 16 (Chromium, Safari) and take the oldest away for another one. */
const mostContexts = 14;

/** What has a context. */
interface Holder {
  /** Gives its context away until it is near the window again; false if it is near. */
  release(): boolean;
  /** Takes a new context; false if it is far. */
  comeBack(): boolean;
}

/** The views of a page that have a context of WebGL, in the order in which they got it, and those that had one. */
export class Contexts<View extends Holder> {
  private readonly holders = new Set<View>();
  private readonly released = new Set<View>();
  private readonly waiting = new Set<View>();

  /** A view has a context. */
  add(view: View): void {
    for (const views of [this.holders, this.released, this.waiting]) views.delete(view);
    this.holders.add(view);
    this.spare();
  }

  /** A view has ended. */
  remove(view: View): void {
    for (const views of [this.holders, this.released, this.waiting]) views.delete(view);
    this.spare();
  }

  /** Takes the contexts of far views away while there are many, and gives room to those that wait. */
  spare(): void {
    for (const view of this.holders) {
      if (this.holders.size <= fewContexts) break;
      if (!view.release()) continue;
      this.holders.delete(view);
      this.released.add(view);
    }
    for (const view of this.waiting) {
      if (this.holders.size >= mostContexts) return;
      if (!view.comeBack()) continue;
      this.waiting.delete(view);
      this.holders.add(view);
    }
  }

  /** Whether the context of a view was given away, and not lost. */
  isReleased(view: View): boolean {
    return this.released.has(view);
  }

  /** A view is without its context. Returns what it says; undefined: that it has lost the device. */
  lost(view: View): string | undefined {
    if (this.isReleased(view)) return "";
    if (this.holders.size <= mostContexts) return undefined;
    this.holders.delete(view);
    this.waiting.add(view);
    return "This page shows more fields than the browser draws at once, often 16. This one comes back when others go.";
  }
}
