/** The npm package `sward`: reads fields of grass, and draws them by WebGPU or WebGL 2. See docs/web.md. */
export { SwardError } from "./format/error";
export type { ErrorKind } from "./format/error";
export { Field, openField, pageBlades, readField } from "./format/field";
export type { BladeArrays } from "./format/blades";
export { Patches, patchWord, patchWords } from "./format/patches";
export type { Camera, Defaults, Organ, Species } from "./format/texts";
export type { Ground, GroundImage, GroundMaterial, GroundRange } from "./format/ground";
export type { FetchOptions } from "./format/source";
export { xxh3 } from "./format/xxh3";
export { Renderer } from "./render/renderer";
export { WebGpuRenderer } from "./render/webgpu/renderer";
export { makeRenderer } from "./render/choice";
export type { AnyRenderer, RendererKind } from "./render/choice";
export { openDevice } from "./render/webgpu/device";
export type { DrawInput, DrawStats } from "./render/renderer";
export type { HostInput } from "./render/host";
export { checkCover, noCover, parseCoverFile } from "./render/cover";
export type { Cover } from "./render/cover";
export { lightAt, usualLight, usualSun } from "./render/light";
export type { Light } from "./render/light";
export { fittingCamera } from "./render/camera";
export { Sowing } from "./sow/sowing";
export type { SowOptions } from "./sow/sowing";
/** The sower itself, for tests. */
export { bladeId } from "./format/blades";
export { compileSower, numbersOf, SowModule } from "./sow/module";
export { pagesOf } from "./sow/pages";
export { unpackFrame } from "./format/container";
export { Grass, groundMesh } from "./page/grass";
export type { GrassOptions } from "./page/grass";
export { FieldView, showField } from "./page/page";
export type { ShowOptions } from "./page/page";
export type { Mode } from "./page/controls";
/** The stages in GLSL ES, for tests. */
export * as shaders from "./generated/shaders";
/** The stages in WGSL and the places of uniforms, for tests. */
export { textOf as wgslOf } from "./render/webgpu/stages";
