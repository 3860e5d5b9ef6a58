import { Camera, Vec3 } from "../format/texts";
import { View } from "./camera";
import type { Gl } from "./gl";
import { Light } from "./light";
import { add, dot, scaled, unit } from "./vector";

/** How a host's scene sees the grass. Matrices are those of OpenGL, column by column. */
export interface HostInput {
  /** From the host's eye space into clip space. Perspective, depth from −1 near to 1 far. */
  projection: ArrayLike<number>;
  /** From the host's world into its eye space. */
  view: ArrayLike<number>;
  /** From places relative to the field's origin into the host's world: a rotation and a translation; none by default. */
  place?: ArrayLike<number>;
  /** [s] of the wind. */
  time: number;
  /** [s] since the picture before; 0: nothing moves. */
  elapsed: number;
  /** In the host's world. */
  light?: Light;
  /** Factor of the field's wind; 1 by default. */
  wind?: number;
  /** Blades at most; beyond it level of detail leaves out more. */
  maxBlades?: number;
  /** Whether the field's ground is drawn, too. */
  ground?: boolean;
  /** The framebuffer, with depth; by default that of the canvas. */
  framebuffer?: WebGLFramebuffer | null;
  /** Its size [pixels]; by default that of the canvas. */
  width?: number;
  height?: number;
  /** Whether the framebuffer keeps linear light; by default it keeps sRGB. */
  isLinear?: boolean;
}

type Matrix = ArrayLike<number>;

/** Row `i` of a matrix. */
const rowOf = (m: Matrix, i: number) => [m[i], m[4 + i], m[8 + i], m[12 + i]];

/** Rows of a · b. */
function rowsOfProduct(a: number[][], b: Matrix): number[][] {
  return a.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, x, k) => sum + x * b[4 * c + k], 0)));
}

/** The view of a host, in the field's coordinates. `usualLight` has them already. */
export function hostView(
  input: HostInput,
  height: number,
  usualLight: Light,
): { view: View; camera: Camera; light: Light } {
  const own = [0, 1, 2, 3].map((i) => rowOf(input.view, i));
  const inEye = input.place ? rowsOfProduct(own, input.place) : own;
  // The eye: where the rotation meets the translation. Rows of the rotation are the axes of the eye.
  const axes = inEye.slice(0, 3).map((row) => row.slice(0, 3) as Vec3);
  const eye = axes.reduce<Vec3>((sum, axis, i) => add(sum, scaled(axis, -inEye[i][3])), [0, 0, 0]);
  const projection = [0, 1, 2, 3].map((i) => rowOf(input.projection, i));
  const [x, y, z, w] = projection.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, v, k) => sum + v * inEye[k][c], 0)));
  // Vulkan's clip space, as shaders/shared has it: y downwards, depth 1 near and 0 far. inClip() undoes this.
  const down = y.map((v) => -v);
  const depth = w.map((v, i) => 0.5 * (v - z[i]));
  const viewProjection: number[] = [];
  for (let c = 0; c < 4; ++c) viewProjection.push(x[c], down[c], depth[c], w[c]);
  const plane = (a: number[], b: number[], sign: number) => {
    const sum = a.map((v, i) => v + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((v) => v / length);
  };
  const zero = [0, 0, 0, 0];
  const focal = input.projection[5];
  const forward = scaled(axes[2], -1);
  const turn = (v: Vec3): Vec3 =>
    input.place ? ([0, 1, 2].map((c) => dot(v, [input.place![4 * c], input.place![4 * c + 1], input.place![4 * c + 2]])) as Vec3) : v;
  return {
    view: {
      eye,
      viewProjection,
      planes: [plane(w, x, 1), plane(w, x, -1), plane(w, down, -1), plane(w, down, 1), plane(w, depth, -1), plane(depth, zero, 0)],
      rays: [scaled(axes[0], 1 / input.projection[0]), scaled(axes[1], -1 / focal), forward],
      pixelsPerUnit: 0.5 * focal * height,
    },
    camera: { name: "host", eye, target: add(eye, forward), up: axes[1], fovYDeg: (360 / Math.PI) * Math.atan(1 / focal) },
    light: input.light ? { ...input.light, sunDirection: unit(turn(input.light.sunDirection)) } : usualLight,
  };
}

/** What a host finds again after the grass has been drawn. */
interface HostState {
  framebuffer: WebGLFramebuffer | null;
  viewport: Int32Array;
}

/** Sets the state of a context that passes of this package rely on. */
export function enterHost(gl: Gl): HostState {
  const state: HostState = {
    framebuffer: gl.getParameter(gl.FRAMEBUFFER_BINDING) as WebGLFramebuffer | null,
    viewport: gl.getParameter(gl.VIEWPORT) as Int32Array,
  };
  for (const switchedOff of [gl.BLEND, gl.CULL_FACE, gl.SCISSOR_TEST, gl.STENCIL_TEST, gl.POLYGON_OFFSET_FILL,
    gl.SAMPLE_ALPHA_TO_COVERAGE, gl.SAMPLE_COVERAGE, gl.RASTERIZER_DISCARD])
    gl.disable(switchedOff);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.depthMask(true);
  gl.depthRange(0, 1);
  gl.clearDepth(1);
  gl.clearColor(0, 0, 0, 0);
  gl.colorMask(true, true, true, true);
  gl.cullFace(gl.BACK);
  gl.frontFace(gl.CCW);
  gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, null);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, 0);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, 0);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
  for (const skipped of [gl.UNPACK_ROW_LENGTH, gl.UNPACK_SKIP_ROWS, gl.UNPACK_SKIP_PIXELS]) gl.pixelStorei(skipped, 0);
  // A sampler of the host would stand for those of the textures.
  for (let unit = 0; unit < 12; ++unit) gl.bindSampler(unit, null);
  return state;
}

/** Gives the framebuffer back. All else a host sets anew: three.js by resetState(), Babylon.js by wipeCaches(). */
export function leaveHost(gl: Gl, state: HostState): void {
  gl.bindVertexArray(null);
  gl.bindBuffer(gl.ARRAY_BUFFER, null);
  gl.useProgram(null);
  gl.disable(gl.CULL_FACE);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, state.framebuffer);
  gl.viewport(state.viewport[0], state.viewport[1], state.viewport[2], state.viewport[3]);
}
