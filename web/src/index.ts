/** The npm package `sward`: reads fields of grass, and draws them by WebGL 2. See docs/web.md. */
export { SwardError } from "./format/error";
export type { ErrorKind } from "./format/error";
export { Field, openField, pageBlades, readField } from "./format/field";
export type { BladeArrays } from "./format/blades";
export { Patches, patchWord, patchWords } from "./format/patches";
export type { Camera, Defaults, Organ, Species } from "./format/texts";
export type { Ground, GroundImage, GroundMaterial, GroundRange } from "./format/ground";
export type { FetchOptions } from "./format/source";
export { xxh3 } from "./format/xxh3";
