import { Field } from "../format/field";
import { checkCover, Cover } from "./cover";
import { chosenExposure } from "./exposure";
import { floorOf, noFloor } from "./floor";
import { Scene } from "./frame";
import { meanBladeWidth } from "./tree";
import { Box, scaled, unit } from "./vector";

function boxOf(field: Field): { content: Box; ground: Box } {
  const ground: Box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  const vertices = field.ground.vertices;
  const floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < field.ground.vertexCount; ++v)
    for (let i = 0; i < 3; ++i) {
      ground.low[i] = Math.min(ground.low[i], floats[7 * v + i]);
      ground.high[i] = Math.max(ground.high[i], floats[7 * v + i]);
    }
  const content: Box = { low: [...ground.low], high: [...ground.high] };
  if (field.patches.count > 0)
    for (let i = 0; i < 3; ++i) {
      content.low[i] = Math.min(content.low[i], field.patches.floats[i]);
      content.high[i] = Math.max(content.high[i], field.patches.floats[4 + i]);
    }
  return { content, ground };
}

/** What all frames of a field share. `patches`: of the whole meadow, if the field is sown. */
export function sceneOf(field: Field, cover: Cover, patches = field.patches): Scene {
  checkCover(field, cover);
  const { content, ground } = boxOf(field);
  const gravity = field.defaults.gravity;
  const up = unit(scaled(gravity.direction, -1));
  return {
    field,
    cover,
    content,
    groundBox: ground,
    floor: gravity.blend === 0 ? floorOf(field.ground, up) : noFloor,
    bladeWidth: meanBladeWidth(patches, field.patches.count),
    exposure: chosenExposure(field.ground, cover, field.bladeCount > 0),
  };
}
