// Times of the passes of a frame, by timestamps of the device.
//   node passes.mjs FOLDER [--size 1920x1080] [--frames 60] [--picture out.rgba] [--atomics 32]
// FOLDER: of `sward export FIELD -o FOLDER/`, its files packed by gzip or not.
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { bytesOf, framesOf, gpu, median, option, sayDevice, sizeOf, usualCamera, warmUp } from "./device.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const sward = await import(option("script", join(here, "../dist/sward.js")));
const folder = process.argv[2];
const [width, height] = sizeOf();
const frames = framesOf();

const only32 = option("atomics", "") === "32";
const adapter = await gpu.requestAdapter({ powerPreference: "high-performance" });
sayDevice(adapter.info, adapter.features);
const device = await sward.openDevice({ gpu, acceptsSoftware: true, only32 });
device.addEventListener("uncapturederror", (event) => console.error(event.error.message));
const field = await sward.readField(new Uint8Array(bytesOf(join(folder, "field.sward"))), "field");
const cover = sward.parseCoverFile(bytesOf(join(folder, "field.cover")), "cover");
const begin = performance.now();
const renderer = await sward.WebGpuRenderer.make(undefined, field, cover, { device });
console.log(`${field.bladeCount} blades; pipelines and memory ${(performance.now() - begin).toFixed(0)} ms`);
console.log(`samples are written by ${renderer.has64 ? "atomics of 64 bits" : "two passes of 32 bits"}`);

const set = device.createQuerySet({ type: "timestamp", count: 64 });
const resolved = device.createBuffer({ size: 512, usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC });
const read = device.createBuffer({ size: 512, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
const texture = device.createTexture({ size: [width, height], format: "rgba8unorm", usage: GPUTextureUsage.RENDER_ATTACHMENT });
const times = new Map();
const wholes = [];
const walls = [];
for (let i = 0; i < frames + warmUp; ++i) {
  const timing = { set, names: [] };
  const from = performance.now();
  renderer.drawInto({ camera: usualCamera, time: i / 60, elapsed: 1 / 60 }, texture.createView(), width, height, timing);
  const encoder = device.createCommandEncoder();
  encoder.resolveQuerySet(set, 0, 2 * timing.names.length, resolved, 0);
  encoder.copyBufferToBuffer(resolved, 0, read, 0, 512);
  device.queue.submit([encoder.finish()]);
  await read.mapAsync(GPUMapMode.READ);
  const stamps = new BigUint64Array(read.getMappedRange().slice(0));
  read.unmap();
  if (i < warmUp) continue;
  walls.push(performance.now() - from);
  const at = (k) => Number(stamps[k]) / 1e6;
  timing.names.forEach((name, k) => times.set(name, [...(times.get(name) ?? []), at(2 * k + 1) - at(2 * k)]));
  const last = 2 * timing.names.length - 1;
  wholes.push(at(last) - at(0));
}
console.log(`${width}×${height}, four samples, ${wholes.length} frames, medians [ms]`);
for (const [name, own] of times) console.log(`  ${name.padEnd(14)} ${median(own).toFixed(3)}`);
console.log(`  ${"whole frame".padEnd(14)} ${median(wholes).toFixed(3)}, with the CPU's part ${median(walls).toFixed(3)}`);
console.log(`  blades moved ${renderer.counts.moved}, drawn ${renderer.counts.blades}; large quads ${renderer.counts.quads}, blocks of rows ${renderer.counts.rows}`);
const out = option("picture", "");
if (out) writeFileSync(out, await renderer.readPicture({ camera: usualCamera, time: 1, elapsed: 0 }, width, height));
process.exit(0);
