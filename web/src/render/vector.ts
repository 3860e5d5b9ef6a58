import { Vec3 } from "../format/texts";

/** Vectors of double precision. */
export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const size = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const mix = (a: Vec3, b: Vec3, s: number): Vec3 => add(scaled(a, 1 - s), scaled(b, s));

/** `a` with length 1; `otherwise` if it has none. */
export function unit(a: Vec3, otherwise: Vec3 = [0, 1, 0]): Vec3 {
  const length = size(a);
  return length > 0 ? scaled(a, 1 / length) : otherwise;
}

export const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);

export function smoothstep(low: number, high: number, x: number): number {
  const t = clamp((x - low) / (high - low), 0, 1);
  return t * t * (3 - 2 * t);
}

/** `v` turned about unit `axis` by `angle` [rad]. */
export function turned(v: Vec3, axis: Vec3, angle: number): Vec3 {
  const cosine = Math.cos(angle);
  return add(
    add(scaled(v, cosine), scaled(cross(axis, v), Math.sin(angle))),
    scaled(axis, dot(axis, v) * (1 - cosine)),
  );
}

/** A box, by its lowest and highest corner. */
export interface Box {
  low: Vec3;
  high: Vec3;
}
