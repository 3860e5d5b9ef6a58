import {
  bladeShadowTexels, cullDistance, cullFrustum, cullOrientation, cullPatch, frameBytes, frameLayout, leaveThinned,
  looksBytes, looksLayout,
} from "../generated/layout";
import { Field } from "../format/field";
import { Camera, Look, Vec3 } from "../format/texts";
import { Block } from "./block";
import { axesOf, View } from "./camera";
import { Cover } from "./cover";
import { Floor } from "./floor";
import { Light, lowSunOf, skyUpOf } from "./light";
import { Box, clamp, cross, dot, scaled, size, sub, unit } from "./vector";
import { writeWind } from "./wind";

/** Defaults of FrameSettings. */
export const frameSettings = { lodThreshold: 0.3, minPixels: 0.8, maxLeafArea: 10, clouds: 0.35, samples: 4 };

/** Edge of the map of the ground's shadow [pixels]. */
export const sunMapSize = 2048;

/** All that a frame is made of. */
export interface Scene {
  field: Field;
  cover: Cover;
  content: Box;
  groundBox: Box;
  floor: Floor;
  /** Mean width of the blades [m]. */
  bladeWidth: number;
  /** Of the field, without adaptation. */
  exposure: number;
}

export interface FrameInput {
  view: View;
  camera: Camera;
  light: Light;
  /** Factor of the wind. */
  wind: number;
  /** [s] */
  time: number;
  /** [m] in which blades cast shadows; 0: they do not. */
  shadowDistance: number;
  /** Width below which blades are left out [pixels]. */
  lodThreshold: number;
  /** As TreeView. */
  sparseFrom: number;
  sparseLeast: number;
}

/** Fog that hides a tenth of an object at the length of the content: chosenFog() of src/render/frame/frame.cpp. */
function chosenFog(content: Box, eye: Vec3): number {
  const nearest = [0, 1, 2].map((i) => clamp(eye[i], content.low[i], content.high[i])) as Vec3;
  const reach = Math.max(size(sub(content.high, content.low)), size(sub(eye, nearest)));
  return reach > 0 ? 0.105 / reach : 0;
}

/** Minimum drawn width of a blade [m at 1 m]. */
export const minWidthOf = (view: View): number =>
  frameSettings.minPixels / (view.pixelsPerUnit * Math.sqrt(frameSettings.samples));

/** Writes a frame as frameOf() in src/render/frame/frame.cpp does. */
export function frameBlock(scene: Scene, input: FrameInput): Block {
  const { field, cover, content } = scene;
  const { view, light } = input;
  const block = new Block(frameLayout, frameBytes);
  const origin = field.origin;
  const gravity = field.defaults.gravity;
  const attractor = sub(gravity.attractor, origin);
  const skyUp = skyUpOf(gravity.direction, attractor, gravity.blend, view.eye);

  block.floats("viewProjection", view.viewProjection);
  view.rays.forEach((ray, i) => block.floats(`rays[${i}]`, ray));
  view.planes.forEach((plane, i) => block.floats(`view.planes[${i}]`, plane));
  block.floats("view.eye", view.eye);
  block.floats("view.drawDistance", [field.defaults.drawDistance]);
  block.floats("view.pixelsPerUnit", [view.pixelsPerUnit]);
  block.floats("view.lodThreshold", [input.lodThreshold]);
  block.floats("view.lodWidth", [scene.bladeWidth]);
  block.floats("view.minWidth", [minWidthOf(view)]);
  block.floats("view.maxLeafArea", [frameSettings.maxLeafArea]);
  block.floats("view.maxEdgeOn", [1]);
  block.words("view.samples", [frameSettings.samples]);
  block.words("view.cullMask", [cullPatch | cullOrientation | cullFrustum | cullDistance | leaveThinned]);
  block.floats("view.areaFactor", [cover.areaFactor]);
  block.floats("view.sparseFrom", [input.sparseFrom]);
  block.floats("view.sparseLeast", [input.sparseLeast]);
  block.words("maxTessellation", [16]);

  const environment = "environment.gravity.";
  block.floats(`${environment}direction`, unit(gravity.direction, [0, -1, 0]));
  block.floats(`${environment}strength`, [gravity.strength]);
  block.floats(`${environment}attractor`, attractor);
  block.floats(`${environment}blend`, [gravity.blend]);
  block.floats(`${environment}forward`, [0.25]);
  block.floats("environment.recovery", [field.defaults.recovery]);
  const extent = Math.max(...sub(content.high, content.low));
  writeWind(block, field.defaults.wind, origin, extent, input.wind, input.time);

  block.floats("sunDirection", light.sunDirection);
  block.floats("sunColor", light.sunColor);
  block.floats("skyColor", light.skyColor);
  block.floats("groundColor", light.groundColor);
  block.floats("skyUp", skyUp);
  block.floats("exposure", [scene.exposure * light.adaptation]);
  block.floats("lowSun", [lowSunOf(dot(light.sunDirection, skyUp))]);
  block.floats("fogDensity", [chosenFog(content, view.eye)]);
  block.floats("clouds", [frameSettings.clouds]);
  writeCover(block, cover, field.defaults.drawDistance);
  writeSun(block, scene.groundBox, light.sunDirection);
  if (input.shadowDistance > 0) writeBladeShadow(block, view, input.camera, light.sunDirection, input.shadowDistance);
  const floor = scene.floor;
  block.floats("floorPlane.middle", floor.middle);
  block.floats("floorPlane.reach", [floor.reach]);
  block.floats("floorPlane.along", floor.along);
  block.floats("floorPlane.height", [floor.height]);
  block.floats("floorPlane.halfSides", floor.halfSides);
  block.floats("floorPlane.cornerRadius", [floor.cornerRadius]);
  return block;
}

function writeCover(block: Block, cover: Cover, drawDistance: number): void {
  block.floats("cover.low", cover.low);
  block.floats("cover.cellsPerMetre", [cover.cellsPerMetre]);
  block.words("cover.countX", [cover.counts[0]]);
  block.words("cover.countY", [cover.counts[1]]);
  block.words("cover.countZ", [cover.counts[2]]);
  block.floats("cover.farthest", [drawDistance]);
  block.floats("cover.undergrowth", cover.undergrowth);
  block.floats("cover.thatch", [1]);
  block.floats("cover.sward", cover.sward);
  block.floats("cover.thinned", [cover.thinned]);
  block.floats("cover.structure", [cover.structure]);
  block.floats("cover.stepsPerMetre", [cover.stepsPerMetre]);
  cover.leaves.forEach((word, i) => block.words(`cover.leaves[${i}]`, [word]));
}

/** First two axes of a frame about unit `n`: tangentOf() and bitangentOf() of shaders/shared/octahedral.h. */
function axesAbout(n: Vec3): [Vec3, Vec3] {
  const s = n[2] >= 0 ? 1 : -1;
  const a = -1 / (s + n[2]);
  return [
    [1 + s * n[0] * n[0] * a, s * n[0] * n[1] * a, -s * n[0]],
    [n[0] * n[1] * a, s + n[1] * n[1] * a, -n[1]],
  ];
}

/** The ground in the sun's view: sunShadowOf() of src/render/preview/sun_shadow.cpp. */
function writeSun(block: Block, ground: Box, sun: Vec3): void {
  if (!(ground.low[0] <= ground.high[0])) return;
  const rim = 2;
  const axes = [...axesAbout(sun), sun];
  const centre = [0, 1, 2].map((i) => 0.5 * (ground.low[i] + ground.high[i])) as Vec3;
  const half = [0, 1, 2].map((i) => 0.5 * (ground.high[i] - ground.low[i])) as Vec3;
  const reach = axes.map((axis) => Math.max(dot(axis.map(Math.abs) as Vec3, half), 1e-6));
  const scales = [(0.5 * sunMapSize - rim) / reach[0], (0.5 * sunMapSize - rim) / reach[1], 0.49 / reach[2]];
  const row = (i: number, middle: number) => [...scaled(axes[i], scales[i]), middle - scales[i] * dot(axes[i], centre)];
  block.floats("shadow.across", row(0, 0.5 * sunMapSize));
  block.floats("shadow.down", row(1, 0.5 * sunMapSize));
  block.floats("shadow.depth", row(2, 0.5));
  block.words("shadow.size", [sunMapSize]);
  block.floats("shadow.texel", [1 / Math.min(scales[0], scales[1])]);
  block.floats("shadow.epsilon", [4e-6]);
}

/** Rows of the sun's view of the blades near the eye: shadowBoxOf() of src/render/frame/shadow_box.cpp. */
export function shadowRows(view: View, camera: Camera, sun: Vec3, distance: number): number[][] {
  const half = 0.5 * distance;
  const across = unit(cross(Math.abs(sun[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], sun));
  const down = cross(sun, across);
  const middle = axesOf(camera).forward.map((x, i) => view.eye[i] + half * x) as Vec3;
  const texel = (2 * half) / bladeShadowTexels;
  const stepped = (axis: Vec3) => Math.round(dot(axis, middle) / texel) * texel;
  const length = 3 * half;
  return [
    [...scaled(across, 1 / half), -stepped(across) / half],
    [...scaled(down, 1 / half), -stepped(down) / half],
    [...scaled(sun, 1 / length), (half - stepped(sun)) / length],
  ];
}

function writeBladeShadow(block: Block, view: View, camera: Camera, sun: Vec3, distance: number): void {
  const rows = shadowRows(view, camera, sun, distance);
  const half = 0.5 * bladeShadowTexels;
  const inTexels = (row: number[]) => row.map((x, i) => half * x + (i === 3 ? half : 0));
  block.floats("bladeShadow.across", inTexels(rows[0]));
  block.floats("bladeShadow.down", inTexels(rows[1]));
  block.floats("bladeShadow.depth", rows[2]);
  block.words("bladeShadow.size", [bladeShadowTexels]);
  block.floats("bladeShadow.nearer", [1 / (bladeShadowTexels * 3)]);
}

/** Planes of the sun's view: seenBySun() of src/render/frame/shadow_box.cpp. */
export function shadowPlanes(rows: number[][]): number[][] {
  const one = [0, 0, 0, 1];
  const plane = (a: number[], b: number[], sign: number) => {
    const sum = a.map((x, i) => x + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((x) => x / length);
  };
  const zero = [0, 0, 0, 0];
  return [
    plane(one, rows[0], 1), plane(one, rows[0], -1), plane(one, rows[1], 1), plane(one, rows[1], -1),
    plane(one, rows[2], -1), plane(rows[2], zero, 0),
  ];
}

/** The looks of all species and organs, as FRAME's tables have them. */
export function looksBlock(field: Field): Block {
  const block = new Block(looksLayout, looksBytes);
  const radians = (degrees: number) => (degrees * Math.PI) / 180;
  const write = (at: string, look: Look, firstOrgan: number, organKinds: number) => {
    block.floats(`${at}rootColor`, look.rootColor);
    block.floats(`${at}tipThreshold`, [look.tipThreshold]);
    block.floats(`${at}tipColor`, look.tipColor);
    block.floats(`${at}groundTint`, [look.groundTint]);
    block.floats(`${at}colorVariation`, [look.colorVariation]);
    block.floats(`${at}translucency`, [look.translucency]);
    block.floats(`${at}gloss`, [look.gloss]);
    block.floats(`${at}dryness`, [look.dryness]);
    block.words(`${at}shape`, [look.shape]);
    block.floats(`${at}fold`, [look.fold]);
    block.words(`${at}firstOrgan`, [firstOrgan]);
    block.words(`${at}organKinds`, [organKinds]);
  };
  let next = 0;
  field.species.forEach((species, i) => {
    write(`species[${i}].`, species, species.organs.length > 0 ? next : 0, species.organs.length);
    for (const organ of species.organs) {
      const at = `organs[${next++}].`;
      write(`${at}look.`, organ, 0, 0);
      block.words(`${at}count`, [organ.count]);
      block.floats(`${at}place`, organ.place);
      block.floats(`${at}pitch`, organ.pitch.map(radians));
      block.floats(`${at}size`, organ.length);
      block.floats(`${at}width`, [organ.width]);
      block.floats(`${at}azimuth`, [radians(organ.azimuth)]);
      block.floats(`${at}turn`, [radians(organ.turn)]);
      block.floats(`${at}bend`, [radians(organ.bend)]);
      block.floats(`${at}leg`, [legLength(radians(organ.bend))]);
      block.floats(`${at}variation`, [organ.variation]);
    }
  });
  return block;
}

/** legLength() of shaders/shared/organ.h. */
function legLength(bend: number): number {
  let sum = 0;
  for (let i = 0; i <= 32; ++i) {
    const t = i / 32;
    const speed = Math.sqrt(Math.max(1 - 2 * t * (1 - t) * (1 - Math.cos(bend)), 0));
    sum += (i === 0 || i === 32 ? 1 : i % 2 === 1 ? 4 : 2) * speed;
  }
  return (0.5 * 96) / sum;
}
