import { fail } from "../format/error";
import { Field, openField } from "../format/field";
import { checkOptions, expectOption, numberIn } from "../format/options";
import { Camera, Vec3 } from "../format/texts";
import { fittingCamera } from "../render/camera";
import { AnyRenderer, makeRenderer, RendererKind } from "../render/choice";
import { coverAt, noCover } from "../render/cover";
import { lightAt, usualSun } from "../render/light";
import { Renderer } from "../render/renderer";
import { Sowing } from "../sow/sowing";
import type { SowOptions } from "../sow/sowing";
import { clamp, scaled, size, sub, unit } from "../render/vector";
import { Contexts } from "./contexts";
import { Controls, Mode } from "./controls";
import { GroundHeight } from "./ground_height";
import { checkCamera, showRules } from "./options";
import { Panel } from "./panel";

/** What showField() shows. */
export interface ShowOptions {
  /** Address of the field. */
  field: string;
  /** Address of what `sward export` wrote beside it; without it blades do not shade one another. */
  cover?: string;
  /** First view; by default the field's first camera, or all of it. */
  camera?: Camera;
  /** Whether there are controls; true by default. */
  panel?: boolean;
  /** How a field with seeds is sown; false: its stored blades alone are shown. */
  sow?: SowOptions | false;
  /** What draws; by default WebGPU where a graphics card offers it, else WebGL 2. */
  renderer?: RendererKind;
}

/** Blades that come before the first picture [pages of 1024]: 6 MB. */
const firstPages = 384;
/** Pages that are asked for together, and requests at once. */
const pagesAtOnce = 128;
const requestsAtOnce = 4;
const minBlades = 60_000;
/** Blades of a frame, first and at most: WebGPU draws far more. */
const firstBlades = { webgl: 150_000, webgpu: 1_000_000 };
const maxBlades = { webgl: 2_000_000, webgpu: 4_000_000 };
/** [ms] that a message stands which asks for nothing. */
const messageTime = 6000;
/** Longest time between two frames that moves blades [s]: a tab that was hidden does not jump. */
const longestFrame = 0.1;
/** Pixels of a side at most: what devices have. */
const mostPixels = 8192;
/** [ms] without a change after which a picture at rest is refined. */
const rest = 250;

/** A field in an element of a page. */
export class FieldView {
  canvas!: HTMLCanvasElement;
  readonly panel: Panel;
  controls!: Controls;
  /** Pictures drawn. */
  frames = 0;
  /** Milliseconds from one frame to the next, smoothed. */
  frameTime = 0;
  private windFactor = 1;
  private hourOfDay = 9;
  private detailFactor = 1;
  /** The view of all of the field, while nobody has moved it. */
  private whole: Camera | undefined;
  private ratio = 1;
  /** Whether the element has a size, and whether it is in the window or near it. */
  private hasSize = false;
  private isNear = true;
  private context: WEBGL_lose_context | null = null;
  private time = 0;
  private last = 0;
  private isDirty = true;
  private changedAt = 0;
  private isRefined = false;
  private requests = 0;
  private budget: number;
  private isLost = false;
  private isStopped = false;
  private hasFailed = false;
  private readonly observer: ResizeObserver;
  private readonly nearness: IntersectionObserver;
  private readonly heights: GroundHeight | undefined;
  private readonly stillness = matchMedia("(prefers-reduced-motion: reduce)");

  constructor(
    readonly element: HTMLElement,
    readonly field: Field,
    public renderer: AnyRenderer,
    panel: Panel,
    camera: Camera | undefined,
  ) {
    this.panel = panel;
    this.budget = firstBlades[renderer.kind];
    const isPlanet = field.defaults.gravity.blend > 0;
    this.heights = isPlanet ? undefined : new GroundHeight(field.ground, this.up);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(element);
    this.nearness = new IntersectionObserver((found) => this.approach(found[found.length - 1].isIntersecting), { rootMargin: "50%" });
    this.adopt(renderer, camera ?? field.defaults.cameras[0]);
    this.nearness.observe(element);
    document.addEventListener("visibilitychange", this.wake);
    requestAnimationFrame(this.tick);
  }

  /** Takes a renderer with its canvas. */
  private adopt(renderer: AnyRenderer, camera: Camera | undefined): void {
    this.renderer = renderer;
    this.canvas = renderer.canvas;
    const { content } = renderer.scene;
    this.resize();
    this.controls = new Controls(
      this.canvas,
      camera ?? (this.whole = this.wholeView()),
      this.up,
      size(sub(content.high, content.low)),
      this.field.origin,
      (place) => this.heights?.at(place),
      () => this.change(),
    );
    const wasLost = (text = "The graphics device was lost. The picture comes back when it does.") => {
      this.isLost = true;
      this.panel.say(text);
    };
    const { canvas } = this;
    if (renderer.kind === "webgpu") {
      renderer.onLost(() => {
        wasLost();
        void this.replaceRenderer();
      });
      return;
    }
    this.context = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context");
    contexts.add(this);
    canvas.addEventListener("webglcontextlost", (event) => {
      if (this.isStopped) return;
      event.preventDefault();
      wasLost(contexts.lost(this));
      this.approach(this.isNear);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      if (this.isStopped || this.canvas !== canvas) return;
      contexts.add(this);
      renderer.restore();
      this.isLost = false;
      this.panel.say("");
      this.change();
    });
  }

  /** Goes on with another device, or by WebGL 2, on a new canvas. */
  private async replaceRenderer(): Promise<void> {
    const { mode, camera } = this.controls;
    const { renderer: before } = this;
    const canvas = this.canvas.cloneNode() as HTMLCanvasElement;
    this.canvas.replaceWith(canvas);
    try {
      const renderer =
        before.kind === "webgl"
          ? new Renderer(canvas, this.field, before.cover, before.sowing)
          : await makeRenderer(canvas, this.field, before.scene.cover);
      this.adopt(renderer, camera);
      if (this.isStopped) return this.free();
    } catch (error) {
      this.panel.fail(error);
      return;
    }
    this.controls.setMode(mode);
    this.budget = firstBlades[this.renderer.kind];
    this.isLost = false;
    const isOther = this.renderer.kind !== before.kind;
    this.panel.say(isOther ? "The graphics device was lost. Now WebGL draws." : "");
    if (isOther) setTimeout(() => this.panel.say(""), messageTime);
    this.change();
  }

  /** Up direction of the field, against gravity. */
  get up(): Vec3 {
    return unit(scaled(this.field.defaults.gravity.direction, -1));
  }

  /** A camera that shows all of the field. */
  wholeView(): Camera {
    const { renderer, field, canvas } = this;
    const aspect = canvas.width / canvas.height;
    return fittingCamera(renderer.scene.content, field.origin, this.up, renderer.usualLight.sunDirection, aspect);
  }

  /** Factor of the field's wind, 0 to 10. */
  get wind(): number {
    return this.windFactor;
  }

  set wind(factor: number) {
    this.windFactor = numberIn("wind", factor, 0, 10);
    this.change();
  }

  /** Hour of the day, 5 to 19; at 9 the sun stands as in the viewer. */
  get hour(): number {
    return this.hourOfDay;
  }

  set hour(hour: number) {
    this.hourOfDay = numberIn("hour", hour, 5, 19);
    this.change();
  }

  /** Factor of the number of blades that are drawn at most, 0.01 to 100. */
  get detail(): number {
    return this.detailFactor;
  }

  set detail(factor: number) {
    this.detailFactor = numberIn("detail", factor, 0.01, 100);
    this.change();
  }

  /** Ways of moving that the field has: nobody walks on planets. */
  get modes(): Mode[] {
    return this.heights ? ["orbit", "fly", "walk"] : ["orbit", "fly"];
  }

  setMode(mode: Mode): void {
    expectOption("setMode", mode, `one of ${this.modes.join(", ")}`, this.modes.includes(mode));
    this.controls.setMode(mode);
  }

  setCamera(camera: Camera): void {
    checkCamera("setCamera", camera);
    this.controls.camera = camera;
    this.change();
  }

  /** Shows all of the field, also after the element changes its size. */
  showWhole(): void {
    this.setCamera((this.whole = this.wholeView()));
  }

  /** Asks for a new picture: something has changed. */
  change(): void {
    this.isDirty = true;
    this.isRefined = false;
    this.changedAt = performance.now();
    this.panel.follow();
  }

  /** Ends the work in the element, and frees the device: the picture goes. */
  stop(): void {
    if (this.isStopped) return;
    this.isStopped = true;
    this.observer.disconnect();
    this.nearness.disconnect();
    document.removeEventListener("visibilitychange", this.wake);
    this.renderer.sowing?.stop();
    this.free();
  }

  private free(): void {
    contexts.remove(this);
    if (this.renderer.kind === "webgpu") this.renderer.stop();
    else if (!this.isLost) this.context?.loseContext();
  }

  /** Gives the context of WebGL away until the element is near the window again; false if it is near. */
  release(): boolean {
    if (this.isNear || this.isLost) return false;
    this.context?.loseContext();
    return true;
  }

  /** Takes a new context, after the browser has taken the first one for another view; false if nobody sees it. */
  comeBack(): boolean {
    if (this.isNear) void this.replaceRenderer();
    return this.isNear;
  }

  /** The element has come near the window, or gone far away. */
  private approach(isNear: boolean): void {
    this.isNear = isNear;
    contexts.spare();
    if (!isNear) return;
    // Only in a task of its own a context may come back.
    if (this.isLost && contexts.isReleased(this)) setTimeout(() => this.isStopped || this.context?.restoreContext());
    this.wake();
  }

  private readonly wake = (): void => {
    this.last = 0;
    this.change();
  };

  private resize(): void {
    // The canvas lies in the element and has no say in its size.
    const { clientWidth, clientHeight } = this.element;
    this.ratio = devicePixelRatio;
    this.hasSize = clientWidth > 0 && clientHeight > 0;
    if (this.hasSize) this.panel.fit(clientWidth, clientHeight);
    const ratio = Math.min(devicePixelRatio || 1, 2, mostPixels / Math.max(clientWidth, clientHeight, 1));
    const width = Math.max(Math.round(clientWidth * ratio), 1);
    const height = Math.max(Math.round(clientHeight * ratio), 1);
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.canvas.width = width;
    this.canvas.height = height;
    if (this.whole && this.controls?.camera === this.whole) this.controls.camera = this.whole = this.wholeView();
    this.change();
  }

  private readonly tick = (now: number): void => {
    if (this.isStopped) return;
    requestAnimationFrame(this.tick);
    if (devicePixelRatio !== this.ratio) this.resize();
    if (this.isLost || document.hidden || !this.hasSize || !this.isNear) return;
    const since = this.last > 0 ? now - this.last : 0;
    this.last = now;
    this.controls.step(Math.min(since / 1000, longestFrame));
    const blows = this.wind > 0 && !this.stillness.matches;
    const isResting = !blows && !this.controls.isMoving && performance.now() - this.changedAt > rest;
    if (!blows && !this.isDirty && (!isResting || this.isRefined)) return;
    const elapsed = blows ? Math.min(since / 1000, longestFrame) : 0;
    this.isDirty = this.renderer.sowing?.hasNews ?? false;
    this.isRefined = isResting && !this.isDirty;
    this.draw(elapsed, isResting);
    if (blows && since > 0) this.adapt(since);
  };

  private draw(elapsed: number, isFine: boolean): void {
    this.time += elapsed;
    const { azimuth, elevation } = sunAt(this.hour);
    const stats = this.renderer.draw({
      camera: this.controls.camera,
      time: this.time,
      elapsed,
      light: this.hour === 9 ? undefined : lightAt(azimuth, elevation, this.up),
      wind: this.wind,
      // A picture at rest may take longer.
      maxBlades: this.budget * this.detail * (isFine ? 2 : 1),
      isFine,
    });
    if (++this.frames === 1) this.panel.begin();
    this.load(stats.missing);
  }

  /** Fewer blades where frames take long, more where they do not. */
  private adapt(since: number): void {
    this.frameTime = this.frameTime === 0 ? since : 0.9 * this.frameTime + 0.1 * since;
    // A device that is far too slow gets far fewer at once.
    const slow = clamp(40 / this.frameTime, 0.3, 0.97);
    if (this.frameTime > 45) this.budget = Math.max(slow * this.budget, minBlades);
    else if (this.frameTime < 20) this.budget = Math.min(1.02 * this.budget, maxBlades[this.renderer.kind]);
  }

  /** Fetches what is visible and not here, then the rest. */
  private load(missing: readonly number[]): void {
    const { field, panel } = this;
    panel.progress(field);
    if (field.isComplete || this.hasFailed || this.requests >= requestsAtOnce) return;
    let wanted = missing.slice(0, pagesAtOnce);
    for (let page = 0; wanted.length < pagesAtOnce && page < field.pageCount; ++page)
      if (field.isMissing(page) && !wanted.includes(page)) wanted.push(page);
    wanted = wanted.sort((a, b) => a - b);
    if (wanted.length === 0) return;
    ++this.requests;
    loadRuns(field, wanted)
      .then(() => this.change())
      .catch((error: unknown) => {
        // What is here is still drawn.
        this.hasFailed = true;
        panel.fail(error);
      })
      .finally(() => {
        --this.requests;
        panel.progress(field);
      });
  }
}

/** Fetches pages, neighbours in one request. */
async function loadRuns(field: Field, pages: readonly number[]): Promise<void> {
  const runs: [number, number][] = [];
  for (const page of pages) {
    const last = runs[runs.length - 1];
    // A gap of some pages costs less than a request.
    if (last && page - last[1] < 4) last[1] = page + 1;
    else runs.push([page, page + 1]);
  }
  for (const [from, to] of runs) await field.loadPages(from, to);
}

/** Where the sun stands at an hour. */
function sunAt(hour: number): { azimuth: number; elevation: number } {
  const rise = (h: number) => Math.sin((Math.PI * (h - 5)) / 14);
  return {
    azimuth: usualSun.azimuth + 15 * (hour - 9),
    elevation: (usualSun.elevation * rise(hour)) / rise(9),
  };
}

const contexts = new Contexts<FieldView>();

/** What is shown in an element, or is opening there. */
const shownIn = new WeakMap<HTMLElement, { view?: FieldView }>();

/**
 * Shows a field in an element, with controls, instead of what was in it. Errors are shown in the element; the promise
 * fails with them, too.
 */
export async function showField(element: HTMLElement, options: ShowOptions): Promise<FieldView> {
  expectOption("showField: element", element, "an element of a page", element?.nodeType === 1);
  shownIn.get(element)?.view?.stop();
  const place: { view?: FieldView } = {};
  shownIn.set(element, place);
  const canvas = document.createElement("canvas");
  const panel = new Panel(element, canvas);
  try {
    checkOptions("showField", options, showRules, "field");
    const field = await openField(options.field, {
      onProgress: (received, total) => panel.receive(received, total),
    });
    panel.progress(field);
    const [cover] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.loadPages(0, Math.min(firstPages, field.pageCount)),
    ]);
    const sowing = await sowingOf(field, options, panel, () => view.change());
    const renderer = await makeRenderer(canvas, field, cover, options.renderer, sowing);
    if (shownIn.get(element) !== place) {
      sowing?.stop();
      fail("usage", `${field.name}: the element shows another field now`);
    }
    const view: FieldView = new FieldView(element, field, renderer, panel, options.camera);
    place.view = view;
    if (options.panel ?? true) panel.control(view);
    return view;
  } catch (error) {
    panel.fail(error);
    throw error;
  }
}

/** Sows the blades between the stored ones. Without them the field is still shown, and the panel says why. */
async function sowingOf(
  field: Field,
  options: ShowOptions,
  panel: Panel,
  onChange: () => void,
): Promise<Sowing | undefined> {
  if (!field.isSown || options.sow === false) return undefined;
  const onError = (error: unknown) => panel.lacksBlades(error);
  try {
    return await Sowing.open(field, { onChange, onError, ...options.sow });
  } catch (error) {
    onError(error);
    return undefined;
  }
}
