// Checks of web/wgsl, which translates the shaders to WGSL. Writes what fails as JSON.
//   node wgsl_checks.mjs REPOSITORY FOLDER
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { join } from "node:path";

const [root, folder] = process.argv.slice(2);
const from = (path) => import(pathToFileURL(join(root, path)).href);
const { emit } = await from("web/wgsl/emit.mjs");
const { parse, preprocess } = await from("web/wgsl/parse.mjs");
const { placesIn } = await from("web/wgsl/layout.mjs");
const { generate } = await from("web/generate.mjs");
const { generateWgsl, stages, translate } = await from("web/generate_wgsl.mjs");
const { wgslOf } = await from("web/dist/sward.js");

const failures = [];
const translated = (text, how = {}) =>
  emit(parse(preprocess("a", () => text, { TABLE: [["N", "T"], "table N T;"] })), { stage: "compute", ...how }).pieces.join("\n");

/** Body of main() after a translation of statements. */
function holds(what, statements, expected, before = "") {
  const text = translated(`${before}layout(local_size_x = 1) in;\nlayout(binding = 0) buffer B { float b[]; };\nvoid main()\n{\n${statements}\n}\n`);
  const body = text.slice(text.indexOf("fn main("));
  if (!body.includes(expected)) failures.push(`${what}: no "${expected}" in ${body}`);
}

// What differs between the languages.
holds("literals become what is wanted", "b[0] = 1 + 0.5f;", "b_[0] = 1.0 + 0.5;");
holds("integers become floats", "int i = 3; b[0] = i;", "b_[0] = f32(i);");
holds("shifts take unsigned numbers", "const uint i = 3u; b[0] = float((i >> 1) & 3u);", "f32((i >> 1u) & 3u)");
holds("vectors of bits take vectors", "const uvec2 v = uvec2(7u); b[0] = float((v & 3u).x);", "v & vec2u(3u)");
holds("a choice of plain values", "const float x = 2.0; b[0] = x > 1.0 ? x : 0.0;", "select(0.0, x, x > 1.0)");
holds("a choice of calls is a statement", "b[0] = b[1] > 1.0 ? f(2.0) : f(3.0);", "if (b_[1] > 1.0) {", "float f(float x) { return x * x; }\n");
holds("several components", "vec3 v = vec3(1.0); v.xz *= 2.0; b[0] = v.x;", "v.z = t1_.y;");
holds("equality of vectors", "const ivec2 v = ivec2(1); b[0] = v == ivec2(2) ? 1.0 : 0.0;", "all(v == vec2i(2))");
holds("arguments that change", "float x = 1.0; twice(x); b[0] = x;", "twice(&x);", "void twice(inout float x) { x *= 2.0; }\n");
holds("functions by their arguments", "b[0] = f(1.0) + f(2u);", "f(1.0) + f_2(2u)", "float f(float x) { return x; }\nfloat f(uint x) { return float(x); }\n");
holds("branches that are known fall away", "if (isOn) b[0] = 1.0; else b[0] = 2.0;", "b_[0] = 2.0;", "const bool isOn = false;\n");
holds("tables are bindings", "b[0] = float(frame.list.at[2].x);", "f32(list_[2].x)", "struct E { uint x; };\nTABLE(T, E)\nstruct F { T list; float y; };\nlayout(binding = 1) buffer L { E list[]; };\nlayout(binding = 2) uniform U { F frame; };\n");
holds("atomics are loaded as such", "atomicAdd(sum[0], 1u); b[0] = float(sum[1]);", "f32(atomicLoad(&sum_[1]))", "layout(binding = 1) buffer S { uint sum[]; };\n");
holds("reserved words", "const float active = 1.0; b[0] = active;", "b_[0] = active_;");
holds("loops with two steps", "uint k = 0u; for (uint i = 0u; i < 4u; ++i, k += 2u) b[i] = float(k);", "continuing {");

const uniform = translated("struct S { float x; uint a[3]; vec3 v; };\nlayout(local_size_x = 1) in;\nlayout(binding = 0) uniform U { S s; };\nlayout(binding = 1) buffer B { float b[]; };\nvoid main() { b[0] = s.x + float(s.a[1]) + s.v.y; }\n");
if (!uniform.includes("s_.a[1].x")) failures.push("elements of uniforms have 16 bytes");

try {
  translated("layout(local_size_x = 1) in;\nvoid main()\n{\n    unknown(1.0);\n}\n");
  failures.push("an unknown function is translated");
} catch (error) {
  if (!error.message.startsWith("a:4: no function unknown")) failures.push(`an error says ${error.message}`);
}

// The places of uniforms are those of layout.ts, which the renderers fill: of WGSL's text by WGSL's rules.
const done = translate();
generate(folder);
const layout = readFileSync(join(folder, "layout.ts"), "utf8");
for (const [struct, name] of [["Frame", "frame"], ["Looks", "looks"]]) {
  const wanted = JSON.parse(new RegExp(`${name}Layout: .*? = (\\{.*?\\});`).exec(layout)[1]);
  const { size, members } = placesIn(done.resolve.pieces, struct);
  if (size !== Number(new RegExp(`${name}Bytes = (\\d+)`).exec(layout)[1])) failures.push(`size of ${struct}`);
  for (const [path, at] of Object.entries(wanted)) if (members[path] !== at) failures.push(`${struct}.${path}: ${members[path]} instead of ${at}`);
}

// What the specification lets every device have.
const texts = generateWgsl(null);
for (const [name, text] of Object.entries(texts)) {
  const buffers = [...text.matchAll(/var<storage/g)].length;
  if (buffers > 8) failures.push(`${name} has ${buffers} storage buffers`);
  if (wgslOf(name) !== text.trimEnd()) failures.push(`${name} of web/dist/sward.js is other text: run \`npm ci && npm run build\` in web/`);
}
if (Object.keys(texts).length !== Object.keys(stages).length) failures.push("stages");
console.log(JSON.stringify(failures));
