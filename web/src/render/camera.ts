import { Camera, Vec3 } from "../format/texts";
import { add, Box, cross, dot, scaled, size, sub, unit } from "./vector";

/** What a frame knows of its camera; positions are relative to the field's origin. */
export interface View {
  eye: Vec3;
  /** Column by column; y downwards and reversed depth, as in the viewer. */
  viewProjection: number[];
  /** left right bottom top near far: unit normals inward, offset. */
  planes: number[][];
  /** See rayThrough() in shaders/common/view_ray.glsl. */
  rays: Vec3[];
  /** Pixels of something 1 m large at 1 m distance. */
  pixelsPerUnit: number;
}

/** Axes of a camera: to the right, up and forward. */
export function axesOf(camera: Camera): { right: Vec3; up: Vec3; forward: Vec3 } {
  const forward = unit(sub(camera.target, camera.eye), [0, 0, -1]);
  let right = cross(forward, camera.up);
  if (size(right) < 1e-6 * size(camera.up) || size(camera.up) === 0) {
    const away = forward.map(Math.abs);
    const axis: Vec3 =
      away[2] <= away[0] && away[2] <= away[1] ? [0, 0, -1] : away[0] <= away[1] ? [1, 0, 0] : [0, 1, 0];
    right = cross(forward, axis);
  }
  right = unit(right);
  return { right, up: cross(right, forward), forward };
}

/** The same as viewMatrices() in src/render/frame/camera.cpp. */
export function viewOf(camera: Camera, origin: Vec3, width: number, height: number, content: Box): View {
  const eye = sub(camera.eye, origin);
  const { right, up, forward } = axesOf(camera);
  const gap = [0, 1, 2].map((i) => Math.max(content.low[i] - eye[i], eye[i] - content.high[i], 0)) as Vec3;
  const extent = size(sub(content.high, content.low));
  const near = Math.max(0.5 * size(gap), Math.min(0.05, 1e-3 * extent), 1e-6);
  const reach = [0, 1, 2].map((i) =>
    Math.max(Math.abs(content.low[i] - eye[i]), Math.abs(content.high[i] - eye[i])),
  ) as Vec3;
  const far = Math.max(1.01 * size(reach), 1.01 * near);
  const focal = 1 / Math.tan((camera.fovYDeg * Math.PI) / 360);
  const aspect = width / height;

  // Rows of view · projection: clip = row · (position, 1). w is the depth along the view.
  const row = (axis: Vec3, scale: number) => [...scaled(axis, scale), -scale * dot(axis, eye)];
  const w = row(forward, 1);
  const x = row(right, focal / aspect);
  const y = row(up, -focal);
  const slope = near / (far - near);
  const z = w.map((value, i) => slope * ((i === 3 ? far : 0) - value));
  const viewProjection: number[] = [];
  for (let column = 0; column < 4; ++column) viewProjection.push(x[column], y[column], z[column], w[column]);
  const plane = (a: number[], b: number[], sign: number) => {
    const sum = a.map((value, i) => value + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((value) => value / length);
  };
  const zero = [0, 0, 0, 0];
  // The ray through the middle, and its change to the right and down.
  const rays = [scaled(right, aspect / focal), scaled(up, -1 / focal), forward];
  return {
    eye,
    viewProjection,
    planes: [plane(w, x, 1), plane(w, x, -1), plane(w, y, -1), plane(w, y, 1), plane(w, z, -1), plane(z, zero, 0)],
    rays,
    pixelsPerUnit: 0.5 * focal * height,
  };
}

/** A camera that shows a box from the side of the sun, as the viewer's preset `fit` does on level ground. */
export function fittingCamera(content: Box, origin: Vec3, up: Vec3, sun: Vec3, aspect: number): Camera {
  const fovYDeg = 40;
  const filled = 0.85;
  const sunSide = unit(sub(sun, scaled(up, dot(sun, up))), [1, 0, 0]);
  const beside = cross(up, sunSide);
  const angle = (50 * Math.PI) / 180;
  const extent = sub(content.high, content.low);
  const isLevel = Math.abs(dot(extent, up)) < 0.35 * size(extent);
  const elevation = ((isLevel ? 17 : 24) * Math.PI) / 180;
  const towards = add(scaled(sunSide, Math.cos(angle)), scaled(beside, Math.sin(angle)));
  const forward = sub(scaled(towards, -Math.cos(elevation)), scaled(up, Math.sin(elevation)));
  const right = unit(cross(forward, up));
  const above = cross(right, forward);
  const tanY = filled * Math.tan((fovYDeg * Math.PI) / 360);
  const tanX = tanY * aspect;
  let east = -Infinity;
  let west = -Infinity;
  let north = -Infinity;
  let south = -Infinity;
  let nearest = Infinity;
  let farthest = -Infinity;
  for (let corner = 0; corner < 8; ++corner) {
    const p = [0, 1, 2].map((i) => (corner & (1 << i) ? content.high[i] : content.low[i])) as Vec3;
    const x = dot(p, right);
    const y = dot(p, above);
    const z = dot(p, forward);
    east = Math.max(east, x - tanX * z);
    west = Math.max(west, -x - tanX * z);
    north = Math.max(north, y - tanY * z);
    south = Math.max(south, -y - tanY * z);
    nearest = Math.min(nearest, z);
    farthest = Math.max(farthest, z);
  }
  const depth = Math.min(-(east + west) / (2 * tanX), -(north + south) / (2 * tanY), nearest - 1e-3);
  const middle = 0.5 * (north - south);
  const eye = add(
    add(scaled(right, 0.5 * (east - west)), scaled(above, isLevel ? -south - tanY * depth : middle)),
    scaled(forward, depth),
  );
  return {
    name: "fit",
    eye: add(origin, eye),
    target: add(origin, add(eye, scaled(forward, 0.5 * (nearest + farthest) - depth))),
    up,
    fovYDeg,
  };
}
