import { Field } from "../format/field";
import { groundVertexBytes } from "../format/ground";
import { Patches, patchWords } from "../format/patches";
import { Gl, makeTexture } from "./gl";

/** Texels of a patch, and patches of a row of their texture: web/shaders/blades.glsl. */
export const patchTexels = 7;
export const patchesOfRow = 256;

/** Texels of patches `first` up to, not including, `end`. */
export function patchTexelsOf(patches: Patches, first: number, end: number, room = end - first): Uint32Array {
  const texels = new Uint32Array(4 * patchTexels * room);
  for (let p = first; p < end; ++p)
    texels.set(patches.words.subarray(p * patchWords, (p + 1) * patchWords), 4 * patchTexels * (p - first));
  return texels;
}

/** The patch tree as a texture of seven texels a patch. */
export function patchTable(gl: Gl, patches: Patches): WebGLTexture {
  const rows = Math.max(Math.ceil(patches.count / patchesOfRow), 1);
  const width = patchTexels * patchesOfRow;
  const texels = patchTexelsOf(patches, 0, patches.count, rows * patchesOfRow);
  const texture = makeTexture(gl, gl.RGBA32UI, width, rows);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
  return texture;
}

/** Triangles between rows of vertices. */
export function ribbonIndices(gl: Gl, segments: number, columns: number): WebGLBuffer {
  const list: number[] = [];
  for (let row = 0; row < segments; ++row)
    for (let column = 0; column + 1 < columns; ++column) {
      const first = row * columns + column;
      const above = first + columns;
      list.push(first, first + 1, above, above, first + 1, above + 1);
    }
  const buffer = gl.createBuffer()!;
  gl.bindVertexArray(null);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(list), gl.STATIC_DRAW);
  return buffer;
}

export function groundArrayOf(gl: Gl, field: Field): WebGLVertexArrayObject {
  const array = gl.createVertexArray()!;
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, field.ground.vertices, gl.STATIC_DRAW);
  for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, groundVertexBytes, 0);
  gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, groundVertexBytes, 12);
  gl.vertexAttribPointer(2, 2, gl.FLOAT, false, groundVertexBytes, 16);
  gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, true, groundVertexBytes, 24);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, field.ground.indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return array;
}
