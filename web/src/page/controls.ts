import { Camera, Vec3 } from "../format/texts";
import { axesOf } from "../render/camera";
import { add, clamp, cross, dot, scaled, size, sub, turned, unit } from "../render/vector";

/** Ways of moving: around a place, freely, or on the ground. */
export type Mode = "orbit" | "fly" | "walk";

/** Height of a walker's eye [m]. */
const eyeHeight = 1.7;

/** Keys that move, and the axis and sign of each: right, up, forward. */
const moves: Record<string, [number, number]> = {
  KeyW: [2, 1], ArrowUp: [2, 1], KeyS: [2, -1], ArrowDown: [2, -1], KeyA: [0, -1], ArrowLeft: [0, -1],
  KeyD: [0, 1], ArrowRight: [0, 1], KeyE: [1, 1], PageUp: [1, 1], KeyQ: [1, -1], PageDown: [1, -1],
};

/** Moves a camera by mouse, touch and keys on an element. */
export class Controls {
  mode: Mode = "orbit";
  private readonly held = new Set<string>();
  private readonly pointers = new Map<number, [number, number]>();
  private pinch = 0;
  private isFast = false;

  /**
   * `reach` [m]: size of what is shown. `heightAt`: of the ground along `up`, at a place relative to the field's
   * origin. `onChange` is called when something has moved.
   */
  constructor(
    readonly element: HTMLElement,
    public camera: Camera,
    private readonly up: Vec3,
    private readonly reach: number,
    private readonly origin: Vec3,
    private readonly heightAt: (place: Vec3) => number | undefined,
    private readonly onChange: () => void,
  ) {
    element.addEventListener("pointerdown", (event) => {
      // Events that a script has made have no pointer to capture.
      if (event.isTrusted) element.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
      this.pinch = this.spread();
    });
    element.addEventListener("pointermove", (event) => this.drag(event));
    for (const name of ["pointerup", "pointercancel"] as const)
      element.addEventListener(name, (event) => {
        this.pointers.delete(event.pointerId);
        this.pinch = this.spread();
      });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.dolly(Math.exp(clamp(event.deltaY, -200, 200) * 0.002));
      },
      { passive: false },
    );
    element.addEventListener("keydown", (event) => {
      this.isFast = event.shiftKey;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.code === "Equal" || event.code === "NumpadAdd") this.dolly(0.9);
      else if (event.code === "Minus" || event.code === "NumpadSubtract") this.dolly(1 / 0.9);
      else if (moves[event.code]) this.held.add(event.code);
      else return;
      event.preventDefault();
      this.onChange();
    });
    element.addEventListener("keyup", (event) => {
      this.isFast = event.shiftKey;
      this.held.delete(event.code);
    });
    element.addEventListener("blur", () => this.held.clear());
  }

  /** Whether keys are held, so that the camera moves with time. */
  get isMoving(): boolean {
    return this.held.size > 0;
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    if (mode === "walk") this.land();
    this.onChange();
  }

  /** Moves the camera by the keys that are held for `seconds`. */
  step(seconds: number): void {
    if (this.held.size === 0) return;
    const way = [0, 0, 0];
    for (const code of this.held) way[moves[code][0]] += moves[code][1];
    const { right, forward } = axesOf(this.camera);
    if (this.mode === "orbit") {
      this.turnAround(-0.9 * way[0] * seconds, 0.7 * way[2] * seconds);
      if (way[1] !== 0) this.dolly(Math.exp(-way[1] * seconds));
      return;
    }
    const level = unit(sub(forward, scaled(this.up, dot(forward, this.up))), forward);
    const ahead = this.mode === "walk" ? level : forward;
    const speed = (this.mode === "walk" ? 2.5 : 0.15 * this.reach) * (this.isFast ? 3 : 1) * seconds;
    this.shift(add(add(scaled(right, way[0] * speed), scaled(this.up, way[1] * speed)), scaled(ahead, way[2] * speed)));
    if (this.mode === "walk") this.stand();
    this.onChange();
  }

  private spread(): number {
    const [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  private drag(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const perPixel = Math.PI / Math.max(this.element.clientHeight, 1);
    if (this.pointers.size === 2) {
      const spread = this.spread();
      if (this.pinch > 0 && spread > 0) this.dolly(this.pinch / spread);
      this.pinch = spread;
      this.pan(0.5 * dx, 0.5 * dy);
    } else if (this.mode === "orbit" && (event.buttons !== 1 || event.shiftKey)) this.pan(dx, dy);
    else if (this.mode === "orbit") this.turnAround(-dx * perPixel, -dy * perPixel);
    else this.look(-dx * 0.5 * perPixel, -dy * 0.5 * perPixel);
  }

  /** Turns the eye around the target. */
  private turnAround(side: number, rise: number): void {
    const { camera, up } = this;
    let arm = turned(sub(camera.eye, camera.target), up, side);
    const axis = unit(cross(arm, up), [1, 0, 0]);
    // Not over the poles.
    const angle = Math.acos(clamp(dot(unit(arm), up), -1, 1));
    arm = turned(arm, axis, angle - clamp(angle + rise, 0.05, 3.09));
    this.camera = { ...camera, up, eye: this.above(add(camera.target, arm)) };
    this.onChange();
  }

  /** Turns the view around the eye. */
  private look(side: number, rise: number): void {
    const { camera, up } = this;
    let way = turned(sub(camera.target, camera.eye), up, side);
    const axis = unit(cross(way, up), [1, 0, 0]);
    const angle = Math.acos(clamp(dot(unit(way), up), -1, 1));
    way = turned(way, axis, angle - clamp(angle - rise, 0.05, 3.09));
    this.camera = { ...camera, up, target: add(camera.eye, way) };
    this.onChange();
  }

  /** Brings the eye nearer to the target, or moves it ahead. */
  private dolly(factor: number): void {
    const { camera } = this;
    const arm = sub(camera.eye, camera.target);
    if (this.mode !== "orbit") this.shift(scaled(unit(arm), 0.1 * this.reach * Math.log(factor)));
    else if (size(arm) * factor > 0.02 && size(arm) * factor < 20 * this.reach)
      this.camera = { ...camera, eye: this.above(add(camera.target, scaled(arm, factor))) };
    if (this.mode === "walk") this.stand();
    this.onChange();
  }

  private pan(dx: number, dy: number): void {
    const { camera } = this;
    const { right, up } = axesOf(camera);
    const metres =
      (2 * size(sub(camera.eye, camera.target)) * Math.tan((camera.fovYDeg * Math.PI) / 360)) /
      Math.max(this.element.clientHeight, 1);
    this.shift(add(scaled(right, -dx * metres), scaled(up, dy * metres)));
    this.onChange();
  }

  private shift(way: Vec3): void {
    this.camera = { ...this.camera, eye: add(this.camera.eye, way), target: add(this.camera.target, way) };
  }

  /** The place, lifted above the ground if it lies in it. */
  private above(eye: Vec3): Vec3 {
    const place = sub(eye, this.origin);
    const ground = this.heightAt(place);
    const lift = ground === undefined ? 0 : ground + 0.02 - dot(place, this.up);
    // Below a sheet seen from below the eye may stay.
    return lift > 0 && lift < 0.05 * this.reach ? add(eye, scaled(this.up, lift)) : eye;
  }

  /** Brings the eye above the ground: where it is, else at the target, else in the middle of the field. */
  private land(): void {
    const { camera, up } = this;
    const isOver = (place: Vec3) => this.heightAt(sub(place, this.origin)) !== undefined;
    if (!isOver(camera.eye)) {
      const to = isOver(camera.target) ? camera.target : this.origin;
      const level = sub(sub(camera.target, camera.eye), scaled(up, dot(sub(camera.target, camera.eye), up)));
      this.camera = { ...camera, eye: to, target: add(to, unit(level, [1, 0, 0])) };
    } else {
      const way = sub(camera.target, camera.eye);
      const level = unit(sub(way, scaled(up, dot(way, up))), [1, 0, 0]);
      this.camera = { ...camera, target: add(camera.eye, level) };
    }
    this.stand();
  }

  /** Puts the eye as high above the ground as a person's. */
  private stand(): void {
    const place = sub(this.camera.eye, this.origin);
    const ground = this.heightAt(place);
    if (ground === undefined) return;
    this.shift(scaled(this.up, ground + eyeHeight - dot(place, this.up)));
  }
}
