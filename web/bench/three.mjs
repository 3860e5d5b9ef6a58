// Times of three.js drawing the same blades as instances of a ribbon: no wind, no level of detail, one light.
//   node three.mjs FOLDER [--size 1920x1080] [--frames 60] [--count N] [--picture out.rgba]
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { bytesOf, framesOf, gpu, median, option, sayDevice, sizeOf, usualCamera, warmUp } from "./device.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const sward = await import(option("script", join(here, "../dist/sward.js")));
const folder = process.argv[2];
const [width, height] = sizeOf();
const frames = framesOf();

const adapter = await gpu.requestAdapter({ powerPreference: "high-performance" });
sayDevice(adapter.info, adapter.features);
const features = [...adapter.features].filter((one) => !one.startsWith("chromium-experimental"));
const { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits;
const device = await adapter.requestDevice({ requiredFeatures: features, requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } });

// What three.js asks a browser for.
let target = device.createTexture({ size: [width, height], format: "rgba8unorm", usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
const context = { configure() {}, unconfigure() {}, getCurrentTexture: () => target };
const canvas = { width, height, style: {}, getContext: () => context, addEventListener() {}, removeEventListener() {}, setAttribute() {} };
globalThis.self ??= globalThis;
globalThis.requestAnimationFrame ??= () => 0;
globalThis.cancelAnimationFrame ??= () => {};
Object.defineProperty(globalThis, "navigator", {
  value: { gpu: { requestAdapter: () => gpu.requestAdapter(), getPreferredCanvasFormat: () => "rgba8unorm" }, userAgent: "node" },
  configurable: true,
});
const THREE = await import("three/webgpu");

const field = await sward.readField(new Uint8Array(bytesOf(join(folder, "field.sward"))), "field");
const blades = field.blades(0, Number(option("count", field.bladeCount)));
const segments = 4;
const geometry = new THREE.PlaneGeometry(1, 1, 1, segments);
geometry.translate(0, 0.5, 0);
const place = geometry.attributes.position;
for (let i = 0; i < place.count; ++i) {
  const y = place.getY(i);
  place.setX(i, place.getX(i) * (1 - y * y));
  place.setZ(i, 0.3 * y * y);
}
const material = new THREE.MeshStandardMaterial({ color: 0x4a6b1f, side: THREE.DoubleSide });
const mesh = new THREE.InstancedMesh(geometry, material, blades.count);
const matrix = new THREE.Matrix4();
const turn = new THREE.Quaternion();
for (let i = 0; i < blades.count; ++i) {
  turn.setFromAxisAngle(new THREE.Vector3(0, 1, 0), blades.facing[i]);
  matrix.compose(
    new THREE.Vector3(...blades.root.subarray(3 * i, 3 * i + 3)),
    turn,
    new THREE.Vector3(blades.width[i], blades.height[i], blades.height[i]),
  );
  mesh.setMatrixAt(i, matrix);
}
mesh.frustumCulled = false;
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x9fb8d0);
scene.add(mesh, new THREE.HemisphereLight(0xbfd4ff, 0x405020, 1.2));
const sun = new THREE.DirectionalLight(0xfff0d8, 3);
sun.position.set(0.72, 0.62, -0.42);
scene.add(sun);
const ground = new THREE.Mesh(new THREE.PlaneGeometry(102.4, 102.4), new THREE.MeshStandardMaterial({ color: 0x5d4a32 }));
ground.rotation.x = -Math.PI / 2;
scene.add(ground);
const camera = new THREE.PerspectiveCamera(usualCamera.fovYDeg, width / height, 0.05, 400);
camera.position.set(...usualCamera.eye);
camera.lookAt(...usualCamera.target);

const renderer = new THREE.WebGPURenderer({ canvas, device, context, antialias: true, trackTimestamp: true });
renderer.setSize(width, height, false);
await renderer.init();
const times = [];
const walls = [];
for (let i = 0; i < frames + warmUp; ++i) {
  const from = performance.now();
  renderer.render(scene, camera);
  await device.queue.onSubmittedWorkDone();
  const wall = performance.now() - from;
  await renderer.resolveTimestampsAsync("render");
  if (i < warmUp) continue;
  walls.push(wall);
  times.push(renderer.info.render.timestamp);
}
console.log(`three.js ${THREE.REVISION}, InstancedMesh of ${blades.count} ribbons of ${segments} segments, ${width}×${height}, four samples, ${frames} frames, medians [ms]`);
console.log(`  timestamps ${median(times).toFixed(3)}, with the CPU's part ${median(walls).toFixed(3)}`);
const out = option("picture", "");
if (out) {
  const bytesPerRow = 256 * Math.ceil((4 * width) / 256);
  const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture: target }, { buffer: read, bytesPerRow }, [width, height]);
  device.queue.submit([encoder.finish()]);
  await read.mapAsync(GPUMapMode.READ);
  const rows = new Uint8Array(read.getMappedRange());
  const pixels = new Uint8Array(4 * width * height);
  for (let y = 0; y < height; ++y) pixels.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + 4 * width), 4 * width * y);
  writeFileSync(out, pixels);
}
process.exit(0);
