import { address, checkOptions, expectOption, flag, Rule } from "../format/options";
import type { Camera } from "../format/texts";
import { isRendererKind, rendererKinds } from "../render/choice";
import { size, sub } from "../render/vector";
import { sowRules } from "../sow/sowing";

const isVector = (value: unknown) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);

function isCamera(value: Camera | null): boolean {
  if (!value || ![value.eye, value.target, value.up].every(isVector)) return false;
  return size(sub(value.eye, value.target)) > 0 && size(value.up) > 0 && value.fovYDeg > 0 && value.fovYDeg < 180;
}

const camera: Rule = [
  "a camera { eye, target, up, fovYDeg }: three numbers each, eye apart from target, an angle between 0 and 180",
  isCamera,
];

/** Fails unless it is a camera. */
export function checkCamera(place: string, value: unknown): void {
  expectOption(place, value, camera[0], isCamera(value as Camera));
}

/** How a field with seeds is sown. */
export const sowing: Rule = [
  "false or an object",
  (value: unknown) => {
    if (typeof value === "object" && value !== null) checkOptions("sow", value, sowRules);
    return value === false || (typeof value === "object" && value !== null);
  },
];

/** Those of showField(). */
export const showRules: Record<string, Rule> = {
  field: address,
  cover: address,
  camera,
  panel: flag,
  sow: sowing,
  renderer: [rendererKinds, isRendererKind],
};
