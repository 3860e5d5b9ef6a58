import { Ground } from "../format/ground";
import { Vec3 } from "../format/texts";
import { cross, dot, scaled, sub, unit } from "../render/vector";

const cells = 512;

/** Heights of the ground along `up`, on a grid: where a walker stands. Of two surfaces the upper one counts. */
export class GroundHeight {
  private readonly along: Vec3;
  private readonly across: Vec3;
  private readonly heights = new Float32Array(cells * cells).fill(NaN);
  private low = [Infinity, Infinity];
  private step = [1, 1];

  constructor(
    ground: Ground,
    up: Vec3,
  ) {
    const side: Vec3 = Math.abs(up[0]) < 0.7 ? [1, 0, 0] : [0, 0, 1];
    this.along = unit(sub(side, scaled(up, dot(side, up))));
    this.across = cross(up, this.along);
    const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
    const places = new Float32Array(3 * ground.vertexCount);
    const high = [-Infinity, -Infinity];
    for (let v = 0; v < ground.vertexCount; ++v) {
      const p = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]] as Vec3;
      const place = [dot(p, this.along), dot(p, this.across), dot(p, up)];
      places.set(place, 3 * v);
      for (const i of [0, 1]) {
        this.low[i] = Math.min(this.low[i], place[i]);
        high[i] = Math.max(high[i], place[i]);
      }
    }
    this.step = [0, 1].map((i) => Math.max((high[i] - this.low[i]) / (cells - 1), 1e-6));
    for (const range of ground.ranges)
      if (range.level === 0)
        for (let i = range.firstIndex; i < range.firstIndex + range.indexCount; i += 3)
          this.fill([0, 1, 2].map((k) => places.subarray(3 * ground.indices[i + k], 3 * ground.indices[i + k] + 3)));
  }

  /** Height along `up` at a place, both relative to the field's origin; undefined beside the ground. */
  at(place: Vec3): number | undefined {
    const x = (dot(place, this.along) - this.low[0]) / this.step[0];
    const y = (dot(place, this.across) - this.low[1]) / this.step[1];
    const [i, j] = [Math.floor(x), Math.floor(y)];
    if (i < 0 || j < 0 || i + 1 >= cells || j + 1 >= cells) return undefined;
    const [u, v] = [x - i, y - j];
    const corner = (k: number, l: number) => this.heights[(j + l) * cells + i + k];
    const height =
      (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) + (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
    return Number.isNaN(height) ? undefined : height;
  }

  /** The grid's points below a triangle. */
  private fill(corners: Float32Array[]): void {
    const [a, b, c] = corners.map((p) => [(p[0] - this.low[0]) / this.step[0], (p[1] - this.low[1]) / this.step[1], p[2]]);
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (Math.abs(area) < 1e-12) return;
    const first = (i: number) => Math.max(Math.ceil(Math.min(a[i], b[i], c[i]) - 1e-6), 0);
    const last = (i: number) => Math.min(Math.floor(Math.max(a[i], b[i], c[i]) + 1e-6), cells - 1);
    for (let y = first(1); y <= last(1); ++y)
      for (let x = first(0); x <= last(0); ++x) {
        const v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
        const w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        if (v < -1e-4 || w < -1e-4 || v + w > 1.0001) continue;
        const height = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
        const at = y * cells + x;
        if (!(this.heights[at] >= height)) this.heights[at] = height;
      }
  }
}
