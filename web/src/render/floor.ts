import { Ground } from "../format/ground";
import { Vec3 } from "../format/texts";
import { add, clamp, cross, dot, scaled, sub, unit } from "./vector";

/** The floor on which the ground stands: shared::FloorPlane. */
export interface Floor {
  middle: Vec3;
  reach: number;
  along: Vec3;
  height: number;
  halfSides: [number, number];
  cornerRadius: number;
}

/** Ground that floats has no floor. */
export const noFloor: Floor = {
  middle: [0, 0, 0], reach: 0, along: [1, 0, 0], height: 0, halfSides: [1, 1], cornerRadius: 0,
};

class Extent {
  low = Infinity;
  high = -Infinity;

  add(value: number): void {
    this.low = Math.min(this.low, value);
    this.high = Math.max(this.high, value);
  }

  get length(): number {
    return Math.max(this.high - this.low, 0);
  }

  get middle(): number {
    return 0.5 * (this.low + this.high);
  }
}

function isSheet(ground: Ground, floats: Float32Array, up: Vec3): boolean {
  let above = 0;
  let below = 0;
  const at = (v: number): Vec3 => [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
  for (const range of ground.ranges) {
    if (range.level !== 0) continue;
    for (let i = range.firstIndex; i + 2 < range.firstIndex + range.indexCount; i += 3) {
      const a = at(ground.indices[i]);
      const area = dot(cross(sub(at(ground.indices[i + 1]), a), sub(at(ground.indices[i + 2]), a)), up);
      if (area > 0) above += area;
      else below -= area;
    }
  }
  return Math.max(above, below) >= 0.8 * (above + below);
}

/** The same as floorPlaneOf() in src/render/preview/floor_plane.cpp. */
export function floorOf(ground: Ground, up: Vec3): Floor {
  const s = up.map(Math.abs);
  const side: Vec3 = s[0] <= Math.min(s[1], s[2]) ? [1, 0, 0] : [0, 0, 1];
  const alongAxis = unit(sub(side, scaled(up, dot(side, up))));
  const acrossAxis = cross(up, alongAxis);
  const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
  const along = new Extent();
  const across = new Extent();
  const above = new Extent();
  const place = (v: number) => {
    const p: Vec3 = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
    return [dot(p, alongAxis), dot(p, acrossAxis), dot(p, up)];
  };
  for (let v = 0; v < ground.vertexCount; ++v) {
    const [x, z, y] = place(v);
    along.add(x);
    across.add(z);
    above.add(y);
  }
  const half = 0.5 * Math.hypot(along.length, across.length);
  if (ground.vertexCount === 0 || !(half > 0)) return noFloor;
  const foot = new Extent();
  const footAcross = new Extent();
  const rim = new Extent();
  let farthest = 0;
  const sides: [number, number] = [Math.max(0.5 * along.length, 1e-6), Math.max(0.5 * across.length, 1e-6)];
  for (let v = 0; v < ground.vertexCount; ++v) {
    const [x, z, y] = place(v);
    const a = Math.abs((x - along.middle) / sides[0]);
    const b = Math.abs((z - across.middle) / sides[1]);
    farthest = Math.max(farthest, Math.hypot(a, b));
    if (Math.max(a, b) >= 0.95) rim.add(y);
    if (y > above.low + 0.02 * above.length) continue;
    foot.add(x);
    footAcross.add(z);
  }
  const sheet = isSheet(ground, floats, up);
  const stands = foot.length >= 0.6 * along.length && footAcross.length >= 0.6 * across.length;
  if (!stands && !sheet) return noFloor;
  const level = sheet ? rim.low : above.low;
  const root = Math.SQRT2;
  return {
    middle: add(add(scaled(alongAxis, along.middle), scaled(acrossAxis, across.middle)), scaled(up, level)),
    reach: 2.5 * half,
    along: alongAxis,
    height: 0.5 * (above.high - level),
    halfSides: sides,
    cornerRadius: Math.min(...sides) * clamp((root - farthest) / (root - 1), 0, 1),
  };
}
