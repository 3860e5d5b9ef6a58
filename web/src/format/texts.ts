import { fail } from "./error";
import { parseJson, SettingsReader } from "./settings";

export type Vec3 = [number, number, number];

/** Outline names of the file, in the order of shapeTriangleTip … in shaders/shared/shape.h. */
export const shapeNames = ["triangle-tip", "quad", "triangle", "quadratic", "dandelion", "leaf"];

/** A leaf beside its stalk has shape 6, which has no name of its own. */
const shapeStalkLeaf = 6;
const maxSpecies = 8;
const maxOrganKinds = 32;
const maxRibbons = 63;

/** Look of a species or of an organ. Colours are linear. */
export interface Look {
  rootColor: Vec3;
  tipColor: Vec3;
  tipThreshold: number;
  groundTint: number;
  colorVariation: number;
  translucency: number;
  gloss: number;
  dryness: number;
  /** Index into shapeNames; 6 for a leaf on a stalk. */
  shape: number;
  fold: number;
}

/** Ribbons of one kind on a stalk; angles in degrees. */
export interface Organ extends Look {
  name: string;
  count: number;
  place: number[];
  pitch: number[];
  length: number[];
  width: number;
  azimuth: number;
  turn: number;
  bend: number;
  variation: number;
}

/** A species of a field. */
export interface Species extends Look {
  name: string;
  /** Of a compound plant; empty for blades. */
  organs: Organ[];
}

/** A saved view, in world space. */
export interface Camera {
  name: string;
  eye: Vec3;
  target: Vec3;
  up: Vec3;
  fovYDeg: number;
}

/** Initial settings of a viewer, in world space. */
export interface Defaults {
  wind: {
    direction: Vec3;
    strength: number;
    waveLength: number;
    speed: number;
    gustSize: number;
    gustiness: number;
  };
  gravity: { direction: Vec3; attractor: Vec3; strength: number; blend: number };
  recovery: number;
  drawDistance: number;
  cameras: Camera[];
  copyright: string;
}

const black: Vec3 = [0, 0, 0];
const farthest = 1e12;

function readLook(reader: SettingsReader, usual: Look): Look {
  const unit = (key: string, value: number, high = 1) => reader.number(key, value, 0, high);
  return {
    rootColor: reader.vector("root_color", usual.rootColor, 0, 1) as Vec3,
    tipColor: reader.vector("tip_color", usual.tipColor, 0, 1) as Vec3,
    tipThreshold: unit("tip_threshold", usual.tipThreshold, 0.99),
    groundTint: unit("ground_tint", usual.groundTint),
    colorVariation: unit("color_variation", usual.colorVariation),
    translucency: unit("translucency", usual.translucency),
    gloss: unit("gloss", usual.gloss),
    dryness: unit("dryness", usual.dryness),
    shape: reader.word("shape", shapeNames, usual.shape),
    fold: unit("fold", usual.fold),
  };
}

const plainLook: Look = {
  rootColor: black, tipColor: black, tipThreshold: 0, groundTint: 0, colorVariation: 0,
  translucency: 0, gloss: 0, dryness: 0, shape: 0, fold: 0,
};

const organLook: Look = {
  ...plainLook,
  rootColor: [0.05, 0.09, 0.02],
  tipColor: [0.2, 0.3, 0.06],
  tipThreshold: 0.5,
  colorVariation: 0.15,
  translucency: 0.4,
  gloss: 0.2,
  shape: shapeNames.indexOf("leaf"),
};

function readOrgan(value: unknown, place: string): Organ {
  const reader = new SettingsReader(value, place);
  const count = reader.number("count", 1, 1, maxRibbons);
  if (!Number.isInteger(count)) fail("input", `${place}.count: ${count} is not a whole number`);
  const look = readLook(reader, organLook);
  // Beside its stalk a leaf does not begin with its whole width.
  if (look.shape === 0) look.shape = shapeStalkLeaf;
  const organ: Organ = {
    ...look,
    name: reader.text("name", ""),
    count,
    place: reader.range("place", [1, 1], 0, 1),
    pitch: reader.range("pitch_deg", [60, 60], 0, 180),
    length: reader.range("length", [0.2, 0.2], 1e-4, 1),
    width: reader.number("width", 0.3, 1e-4, 2),
    azimuth: reader.number("azimuth_deg", 0, -360, 360),
    turn: reader.number("turn_deg", 137.508, -360, 360),
    bend: reader.number("bend_deg", 20, -180, 180),
    variation: reader.number("variation", 0.2, 0, 1),
  };
  reader.finish();
  return organ;
}

/** Ribbons on a stalk with these organs. */
export function ribbonsOf(organs: readonly Organ[]): number {
  return organs.reduce((sum, organ) => sum + organ.count, 0);
}

/** Reads the chunk SPECIES. */
export function parseSpecies(text: string, place: string): Species[] {
  const list = parseJson(text, place);
  if (!Array.isArray(list) || list.length === 0 || list.length > maxSpecies)
    fail("input", `${place}: expected an array of 1 to ${maxSpecies} species`);
  const species = list.map((entry, i): Species => {
    const at = `${place}[${i}]`;
    const reader = new SettingsReader(entry, at);
    const name = reader.text("name", "");
    const look = readLook(reader, plainLook);
    const organs =
      reader.value("organs") === undefined
        ? []
        : reader.array("organs").map((one, k) => readOrgan(one, `${at}.organs[${k}]`));
    reader.finish();
    if (ribbonsOf(organs) > maxRibbons)
      fail("input", `${at}.organs: ${ribbonsOf(organs)} ribbons on a stalk, more than ${maxRibbons}`);
    return { ...look, name, organs };
  });
  const kinds = species.reduce((sum, one) => sum + one.organs.length, 0);
  if (kinds > maxOrganKinds)
    fail("input", `${place}: ${kinds} organs of all species, more than ${maxOrganKinds}`);
  return species;
}

function requireUnit(v: number[], place: string): void {
  if (Math.abs(Math.hypot(...v) - 1) > 1e-3)
    fail("input", `${place}: (${v.join(", ")}) is not a unit vector`);
}

/** Reads the chunk DEFAULTS. */
export function parseDefaults(text: string, place: string): Defaults {
  const reader = new SettingsReader(parseJson(text, place), place);
  const wind = reader.child("wind");
  const gravity = reader.child("gravity");
  const defaults: Defaults = {
    wind: {
      direction: wind.vector("direction", [0.8, 0, 0.6], -1, 1) as Vec3,
      strength: wind.number("strength", 3, 0, 1000),
      waveLength: wind.number("wave_length", 7, 1e-6, 1e9),
      speed: wind.number("speed", 2.6, -1e6, 1e6),
      gustSize: wind.number("gust_size", 3.5, 1e-6, 1e9),
      gustiness: wind.number("gustiness", 0.6, 0, 1),
    },
    gravity: {
      direction: gravity.vector("direction", [0, -1, 0], -1, 1) as Vec3,
      attractor: gravity.vector("attractor", [0, 0, 0], -farthest, farthest) as Vec3,
      strength: gravity.number("strength", 6.5, 0, 1000),
      blend: gravity.number("blend", 0, 0, 1),
    },
    recovery: reader.number("recovery", 6, 1e-3, 1000),
    drawDistance: reader.number("draw_distance", 1e9, 0, 1e30),
    copyright: reader.text("copyright", ""),
    cameras: reader.array("cameras").map((entry, i): Camera => {
      const one = new SettingsReader(entry, `${place}.cameras[${i}]`);
      const camera: Camera = {
        name: one.text("name", "camera"),
        eye: one.vector("eye", [0, 0, 0], -farthest, farthest) as Vec3,
        target: one.vector("target", [0, 0, 0], -farthest, farthest) as Vec3,
        up: one.vector("up", [0, 1, 0], -1, 1) as Vec3,
        fovYDeg: one.number("fov_y_deg", 45, 0.1, 170),
      };
      one.finish();
      return camera;
    }),
  };
  wind.finish();
  gravity.finish();
  reader.finish();
  requireUnit(defaults.wind.direction, wind.placeOf("direction"));
  requireUnit(defaults.gravity.direction, gravity.placeOf("direction"));
  return defaults;
}

/** Reads the chunk COVER: leaf area of the meadow relative to that of the blades. */
export function parseCover(text: string | undefined, place: string): number {
  if (text === undefined || text === "") return 1;
  return new SettingsReader(parseJson(text, place), place).number("thinned", 1, 1, 1e9);
}
