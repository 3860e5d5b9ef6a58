import { SwardError } from "../format/error";
import { Field } from "../format/field";
import { Mode } from "./controls";
import type { FieldView } from "./page";
import { addStyles } from "./styles";

const megabytes = (bytes: number) => `${(bytes / 1e6).toFixed(1)} MB`;

/** Area of an element [CSS pixels²] from which on the controls are unfolded. */
const leastArea = 200_000;

/** An element of HTML with attributes and children. */
function make<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Record<string, string>,
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** Messages, progress and controls of a view. Labels are for people and for screen readers. */
export class Panel {
  private readonly message = make("p", { class: "sward-message", role: "status", "aria-live": "polite" });
  private readonly bar = make("progress", { class: "sward-progress", "aria-label": "Blades that have come", max: "1" });
  private readonly note = make("small", { class: "sward-note", role: "note" });
  private readonly poster: HTMLElement | null;
  private tools: HTMLDetailsElement | undefined;
  private wasFolded = false;
  private readonly followers: (() => void)[] = [];
  private hasFailed = false;

  constructor(
    private readonly element: HTMLElement,
    canvas: HTMLCanvasElement,
  ) {
    element.classList.add("sward");
    addStyles(element);
    // An element within a line has no height to fill.
    if (getComputedStyle(element).display === "inline") element.style.display = "block";
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute(
      "aria-label",
      "A field of grass in three dimensions. Arrow keys turn the view, plus and minus come nearer and go away.",
    );
    // A picture of the field, which the page may hold, stands before it until there is one.
    this.poster = element.querySelector<HTMLElement>(".sward-poster");
    element.replaceChildren(canvas, ...(this.poster ? [this.poster] : []), this.message, this.bar, this.note);
    this.say("The field is coming.");
  }

  /** Shows a text; none if it is empty. */
  say(text: string): void {
    if (this.hasFailed) return;
    this.message.textContent = text;
    this.message.hidden = text === "";
  }

  /** Shows an error instead of anything else. */
  fail(error: unknown): void {
    const text =
      error instanceof SwardError ? error.message : "The field cannot be shown: something unexpected happened.";
    if (!(error instanceof SwardError)) console.error(error);
    this.say(text);
    this.hasFailed = true;
    this.message.setAttribute("role", "alert");
    this.message.classList.add("sward-error");
    this.bar.hidden = true;
  }

  /** The first picture is there: that of the page fades, or goes at once where less motion is asked for. */
  begin(): void {
    const { poster } = this;
    if (!poster) return;
    poster.classList.add("sward-gone");
    if (parseFloat(getComputedStyle(poster).transitionDuration) > 0)
      poster.addEventListener("transitionend", () => poster.remove());
    else poster.remove();
  }

  /** Says that the blades between the stored ones of a field with seeds are missing. */
  lacksBlades(error: unknown): void {
    const why = error instanceof SwardError ? error.message : String(error);
    this.note.append(`These are the stored blades of a field with seeds; the others are not sown: ${why} `);
  }

  /** Bytes of a file that comes as a whole. */
  receive(received: number, total: number): void {
    this.bar.value = received / Math.max(total, 1);
    this.say(`${megabytes(received)} of ${megabytes(total)}`);
  }

  /** How much of a field is here. */
  progress(field: Field): void {
    const share = field.pageCount > 0 ? field.presentPages / field.pageCount : 1;
    this.bar.value = share;
    this.bar.hidden = share >= 1;
    if (this.hasFailed) return;
    this.say(share >= 1 ? "" : `${Math.floor(100 * share)} % of ${field.bladeCount.toLocaleString("en")} blades`);
  }

  /** Shows what the view has, also where a script has set it. */
  follow(): void {
    for (const one of this.followers) one();
  }

  /** Folds the controls where they would hide much of a picture, unless someone has folded or unfolded them. */
  fit(width: number, height: number): void {
    if (this.tools && !this.wasFolded) this.tools.open = width * height >= leastArea;
  }

  /** Adds the controls of a view. */
  control(view: FieldView): void {
    const modes: [Mode, string, string][] = [
      ["orbit", "Orbit", "Drag turns around the field, right drag moves it, the wheel comes nearer"],
      ["fly", "Fly", "Drag looks around; W A S D or arrows fly, E and Q rise and sink, Shift is faster"],
      ["walk", "Walk", "Drag looks around; W A S D or arrows walk on the ground"],
    ];
    const usable = modes.filter(([mode]) => view.modes.includes(mode));
    const buttons = usable.map(([mode, text, title]) => {
      const button = make("button", { type: "button", title }, text);
      button.addEventListener("click", () => {
        view.setMode(mode);
        view.canvas.focus();
      });
      this.followers.push(() => button.setAttribute("aria-pressed", String(view.controls.mode === mode)));
      return button;
    });
    const home = make("button", { type: "button", title: "Show all of the field" }, "Home");
    home.addEventListener("click", () => view.showWhole());
    const slider = (
      text: string,
      low: number,
      high: number,
      step: number,
      shown: (value: number) => string,
      get: () => number,
      set: (value: number) => void,
    ) => {
      const input = make("input", {
        type: "range", min: String(low), max: String(high), step: String(step), "aria-label": text,
      });
      const output = make("output", {});
      let last: number | undefined;
      this.followers.push(() => {
        const value = get();
        if (value === last) return;
        last = value;
        input.value = String(value);
        output.textContent = shown(value);
        input.setAttribute("aria-valuetext", output.textContent);
      });
      input.addEventListener("input", () => set(input.valueAsNumber));
      return make("label", {}, make("span", {}, text), input, output);
    };
    const clock = (hour: number) => {
      const minutes = Math.round(60 * hour);
      return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}`;
    };
    const tools = make(
      "div",
      { role: "toolbar", "aria-label": "View of the field" },
      ...buttons,
      home,
      slider("Wind", 0, 3, 0.1, (x) => `${Math.round(100 * x)} %`, () => view.wind, (x) => (view.wind = x)),
      slider("Time", 5.25, 18.75, 0.25, clock, () => view.hour, (x) => (view.hour = x)),
      slider("Detail", -2, 2, 0.5, (x) => `×${(2 ** x).toFixed(x < 0 ? 2 : 1)}`, () => Math.log2(view.detail), (x) => (view.detail = 2 ** x)),
    );
    const cameras = view.field.defaults.cameras;
    if (cameras.length > 0) {
      const select = make(
        "select",
        { "aria-label": "Saved view" },
        make("option", { hidden: "" }, "Saved views"),
        ...cameras.map((camera, i) => make("option", { value: String(i) }, camera.name)),
      );
      select.addEventListener("change", () => view.setCamera(cameras[select.selectedIndex - 1]));
      // A view that someone has left may be chosen again.
      this.followers.push(() => (select.selectedIndex = 1 + cameras.indexOf(view.controls.camera)));
      tools.append(select);
    }
    this.note.append(view.field.defaults.copyright);
    const summary = make("summary", { title: "Shows or hides the controls" }, "Controls");
    // A click, and the keys Enter and Space.
    summary.addEventListener("click", () => (this.wasFolded = true));
    this.tools = make("details", { class: "sward-tools" }, summary, tools);
    this.fit(this.element.clientWidth, this.element.clientHeight);
    this.element.append(this.tools);
    this.follow();
  }
}
