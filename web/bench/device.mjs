// WebGPU in Node.js by the npm package `webgpu` (Dawn), and what both measurements share.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { create, globals } from "webgpu";

Object.assign(globalThis, globals);

/** Timestamps in steps of nanoseconds, and features that are not finished. */
export const gpu = create(["enable-dawn-features=allow_unsafe_apis", "disable-dawn-features=timestamp_quantization"]);

/** A file as bytes; from its .gz if there is one. */
export function bytesOf(path) {
  let bytes;
  try {
    bytes = readFileSync(path);
  } catch {
    bytes = gunzipSync(readFileSync(`${path}.gz`));
  }
  return new Uint8Array(bytes).buffer;
}

/** `--name value` among the arguments. */
export function option(name, usual) {
  const at = process.argv.indexOf(`--${name}`);
  return at < 0 ? usual : process.argv[at + 1];
}

export const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** The view of assets/bench/1M.json. */
export const usualCamera = { name: "", eye: [0, 3, 51.2], target: [0, 0, 0], up: [0, 1, 0], fovYDeg: 45 };

export const sizeOf = () => option("size", "1920x1080").split("x").map(Number);
/** Frames before those that are measured: the first one settles all blades. */
export const warmUp = Number(option("frames", "60")) >= 16 ? 16 : 1;
export const framesOf = () => Number(option("frames", "60"));

export function sayDevice(info, features) {
  const has64 = features.has("atomic-vec2u-min-max");
  console.log(`${info.vendor} ${info.architecture} ${info.description}; atomics of 64 bits: ${has64 ? "offered" : "not offered"}`);
}
