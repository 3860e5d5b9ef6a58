// Types and functions of GLSL, and what they are in WGSL. Types are GLSL's names; an array is "float[4]", one without a
// size "float[]".

const words = { float: "f32", uint: "u32", int: "i32", bool: "bool" };
const kinds = { v: "float", u: "uint", i: "int", b: "bool" };

export const isScalar = (type) => type in words;
/** Components of a scalar or vector; 0 of others. */
export const sizeOf = (type) => (isScalar(type) ? 1 : Number(/^[iub]?vec([234])$/.exec(type)?.[1] ?? 0));
/** float, uint, int or bool. */
export const scalarOf = (type) => (isScalar(type) ? type : kinds[type[0]]);
export const vectorOf = (scalar, size) =>
  size === 1 ? scalar : `${{ float: "", uint: "u", int: "i", bool: "b" }[scalar]}vec${size}`;
/** Columns and rows of a matrix. */
export const matrixOf = (type) => {
  const found = /^mat([234])(?:x([234]))?$/.exec(type);
  return found && [Number(found[1]), Number(found[2] ?? found[1])];
};
export const elementOf = (type) => /^(.*)\[\w*\]$/.exec(type)?.[1];

/** A type's name in WGSL. */
export function wgslType(type) {
  const array = /^(.*)\[(\w*)\]$/.exec(type);
  if (array) return array[2] === "" ? `array<${wgslType(array[1])}>` : `array<${wgslType(array[1])}, ${array[2]}>`;
  if (isScalar(type)) return words[type];
  const size = sizeOf(type);
  if (size > 1) return `vec${size}${{ float: "f", uint: "u", int: "i", bool: "<bool>" }[scalarOf(type)]}`;
  const matrix = matrixOf(type);
  return matrix ? `mat${matrix[0]}x${matrix[1]}f` : type;
}

/** std140's alignment, which is WGSL's of uniforms, and size of types that are no structs. */
export function spaceOf(type) {
  const size = sizeOf(type);
  if (size > 0) return { align: size === 3 ? 16 : 4 * size, size: 4 * size };
  const [columns, rows] = matrixOf(type);
  return { align: rows === 2 ? 8 : 16, size: columns * (rows === 2 ? 8 : 16) };
}

/** Functions whose arguments and result have one type: scalars are made vectors. */
export const alike = new Set([
  "abs", "sign", "floor", "ceil", "round", "trunc", "fract", "sqrt", "inversesqrt", "exp", "exp2", "log", "log2", "sin",
  "cos", "tan", "asin", "acos", "sinh", "cosh", "tanh", "pow", "min", "max", "clamp", "step", "smoothstep", "fma",
  "radians", "degrees", "normalize", "cross", "reflect", "dFdx", "dFdy", "fwidth",
]);

/** Names that differ in WGSL. */
export const renamed = {
  inversesqrt: "inverseSqrt", dFdx: "dpdx", dFdy: "dpdy", packHalf2x16: "pack2x16float", unpackHalf2x16: "unpack2x16float",
  packUnorm4x8: "pack4x8unorm", unpackUnorm4x8: "unpack4x8unorm", packUnorm2x16: "pack2x16unorm",
  unpackUnorm2x16: "unpack2x16unorm", packSnorm2x16: "pack2x16snorm", unpackSnorm2x16: "unpack2x16snorm",
};

/** Results of functions that do not depend on their arguments. */
export const results = {
  packHalf2x16: "uint", unpackHalf2x16: "vec2", packUnorm4x8: "uint", unpackUnorm4x8: "vec4", packUnorm2x16: "uint",
  unpackUnorm2x16: "vec2", packSnorm2x16: "uint", unpackSnorm2x16: "vec2", dot: "float", length: "float",
  distance: "float", any: "bool", all: "bool", determinant: "float",
};

export const comparisons = {
  lessThan: "<", lessThanEqual: "<=", greaterThan: ">", greaterThanEqual: ">=", equal: "==", notEqual: "!=",
};

export const builtins = {
  gl_WorkGroupID: ["workgroup_id", "uvec3"],
  gl_NumWorkGroups: ["num_workgroups", "uvec3"],
  gl_LocalInvocationID: ["local_invocation_id", "uvec3"],
  gl_LocalInvocationIndex: ["local_invocation_index", "uint"],
  gl_GlobalInvocationID: ["global_invocation_id", "uvec3"],
  gl_VertexIndex: ["vertex_index", "uint"],
  gl_InstanceIndex: ["instance_index", "uint"],
  gl_FragCoord: ["position", "vec4"],
  gl_FrontFacing: ["front_facing", "bool"],
};

/** Words that WGSL reserves, and its functions: variables of these names get another one. */
export const reserved = new Set(
  `NULL Self abstract active alias alignas alignof as asm asm_fragment async attribute auto await become binding_array
  break case cast catch class co_await co_return co_yield coherent column_major common compile compile_fragment
  concept const const_assert const_cast consteval constexpr constinit continue continuing crate debugger decltype
  default delete demote demote_to_helper diagnostic discard do dynamic_cast else enable enum explicit export extends extern
  external fallthrough false filter final finally fn for friend from fxgroup get goto groupshared highp if impl
  implements import inline instanceof interface layout let loop lowp macro macro_rules match mediump meta mod module
  move mut mutable namespace new nil noexcept noinline nointerpolation non_coherent noncoherent noperspective null
  nullptr of operator override package packoffset partial pass patch pixelfragment precise precision premerge
  priv protected pub public readonly ref regardless register reinterpret_cast require requires resource restrict
  return return self set shared sizeof smooth snorm static static_assert static_cast std struct subroutine super switch
  target template this thread_local throw trait true try type typedef typeid typename typeof union unless unorm unsafe
  unsized use using var varying virtual volatile wgsl where while with writeonly yield ptr array atomic vec2 vec3 vec4
  select bitcast all any abs sign floor ceil round trunc fract sqrt exp exp2 log log2 sin cos tan asin acos atan pow min
  max clamp step smoothstep mix normalize cross reflect dot length distance main sampler texture`.split(/\s+/),
);

/** A name that WGSL takes. */
export const safe = (name) => (reserved.has(name) || /^gl_|__/.test(name) ? `${name.replace(/__/g, "_")}_` : name);
