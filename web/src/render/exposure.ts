import { Ground, groundVertexBytes } from "../format/ground";
import { Vec3 } from "../format/texts";
import { Cover, leafAreaAt, leafProjectionOf } from "./cover";
import { usualLight } from "./light";
import { clamp, cross, size, sub } from "./vector";

// The same as src/render/viewer/exposure.cpp.
const exposedGrey = 0.163;
const exposedBright = 1.6;
const meadowBrightness = 0.6;
const adaptation = 0.5;
const usualGround = 0.2;
const fewBlades = 0.05;
const groundSamples = 20000;
const samplesOfTriangle = 256;
const mayClip = 0.01;
const skyExtinction = 1.2;
const lowestSun = 0.1;

const luminance = (c: Vec3) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
const linear = (s: number) => (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4);
const undergrowthBelow = (leafArea: number) => 1 - Math.exp(-0.65 * leafArea);

/** The usual light below `leafArea` of leaves, with the sun at `facing` from the ground's normal. */
function lightBelow(cover: Cover, leafArea: number, facing: number): Vec3 {
  const upwards = leafProjectionOf(cover);
  const risen = Math.max(facing, lowestSun);
  const beside = 0.637 * Math.sqrt(Math.max(1 - 1.9 * upwards * upwards, 0));
  const along = Math.hypot(upwards * risen, beside * Math.sqrt(Math.max(1 - risen * risen, 0)));
  const sun = facing * Math.exp((-along * leafArea) / risen);
  const sky = 1.25 * Math.exp(-skyExtinction * leafArea);
  return [0, 1, 2].map((i) => sun * usualLight.sunColor[i] + sky * usualLight.skyColor[i]) as Vec3;
}

interface Place {
  color: Vec3;
  area: number;
  leafArea: number;
}

function placesOf(ground: Ground, cover: Cover): Place[] {
  const view = new DataView(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length);
  const float = (vertex: number, word: number) => view.getFloat32(groundVertexBytes * vertex + 4 * word, true);
  const position = (v: number): Vec3 => [float(v, 0), float(v, 1), float(v, 2)];
  const color = (v: number) => [0, 1, 2].map((i) => view.getUint8(groundVertexBytes * v + 24 + i) / 255);
  const ranges = ground.ranges.filter((range) => range.level === 0);
  const triangles = ranges.reduce((sum, range) => sum + range.indexCount / 3, 0);
  const stride = Math.max(Math.floor(triangles / groundSamples), 1);
  const each = clamp(Math.floor(groundSamples / Math.max(triangles, 1)), 1, samplesOfTriangle);
  const places: Place[] = [];
  for (const range of ranges) {
    const material = ground.materials[range.material];
    for (let i = 0; i < range.indexCount / 3; i += stride) {
      const corners = [0, 1, 2].map((k) => ground.indices[range.firstIndex + 3 * i + k]);
      const [a, b, c] = corners.map(position);
      const area = (0.5 * stride * size(cross(sub(b, a), sub(c, a)))) / each;
      for (let k = 0; k < each; ++k) {
        const n = places.length;
        let p = (0.5 + n * 0.7548776662466927) % 1;
        let q = (0.5 + n * 0.569840290998053) % 1;
        if (p + q > 1) [p, q] = [1 - p, 1 - q];
        const w = [1 - p - q, p, q];
        const mixed = (values: number[][]) =>
          values[0].map((_, j) => w[0] * values[0][j] + w[1] * values[1][j] + w[2] * values[2][j]);
        const vertex = mixed(corners.map(color));
        const albedo = [0, 1, 2].map((j) => material.baseColor[j] * vertex[j]) as Vec3;
        const image = ground.images[material.image];
        if (image) {
          const uv = mixed(corners.map((v) => [float(v, 4), float(v, 5)]));
          const x = Math.min(Math.floor((uv[0] - Math.floor(uv[0])) * image.width), image.width - 1);
          const y = Math.min(Math.floor((uv[1] - Math.floor(uv[1])) * image.height), image.height - 1);
          for (let j = 0; j < 3; ++j) albedo[j] *= linear(image.pixels[4 * (y * image.width + x) + j] / 255);
        }
        const place = mixed([a, b, c]) as Vec3;
        places.push({ color: albedo, area, leafArea: cover.thinned * leafAreaAt(cover, place) });
      }
    }
  }
  return places;
}

/** The exposure that the viewer chooses for a field by its colours. */
export function chosenExposure(ground: Ground, cover: Cover, hasBlades: boolean): number {
  const cosine = usualLight.sunDirection[1];
  const times = (a: Vec3, b: Vec3): Vec3 => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
  const leaves = hasBlades ? luminance(times(cover.sward, lightBelow(cover, 0, cosine))) : 0;
  let area = 0;
  let open = 0;
  let bare = 0;
  let stops = 0;
  const facing: { radiance: number; area: number }[] = [];
  for (const place of placesOf(ground, cover)) {
    const under = undergrowthBelow(place.leafArea);
    const share = 1 - under;
    const color = place.color.map((c, i) => c * share + cover.undergrowth[i] * under) as Vec3;
    const level = luminance(times(color, lightBelow(cover, place.leafArea, cosine)));
    area += place.area;
    open += share * place.area;
    bare += place.area * luminance(times(place.color, lightBelow(cover, 0, cosine)));
    if (leaves > 0) stops += share * place.area * Math.log(Math.max(level / leaves, 1));
    facing.push({
      radiance: Math.max(...times(color, lightBelow(cover, place.leafArea, 1))),
      area: share * place.area,
    });
  }
  facing.sort((a, b) => b.radiance - a.radiance);
  let brightest = 0;
  let above = 0;
  for (const one of facing) {
    above += one.area;
    if (above < mayClip * area) continue;
    brightest = one.radiance;
    break;
  }
  const seen = area > 0 ? { share: open / area, mean: bare / area, stops: stops / area } : { share: 0, mean: 0, stops: 0 };
  let mean = seen.mean > usualGround ? Math.sqrt(seen.mean * usualGround) : seen.mean;
  let raised = 0;
  if (leaves > 0) {
    const meadow = Math.min((1 - seen.share) / fewBlades, 1);
    mean = (meadowBrightness * leaves) ** meadow * Math.max(mean, 1e-6) ** (1 - meadow);
    raised = meadow * adaptation * seen.stops;
  }
  const wanted = mean > 0 ? (exposedGrey / mean) * Math.exp(-raised) : 1;
  const allowed = brightest > 0 ? exposedBright / brightest : 4;
  return clamp(Math.min(wanted, allowed), 0.25, 4);
}
