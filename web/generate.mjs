// Makes GLSL ES 3.00 of the shaders in shaders/, which include the repository's own headers: what a blade is, how it
// is posed, moved, culled and lit is the same text that g++ and glslang compile. Writes src/generated/:
//   shaders.ts   the text of each stage
//   layout.ts    std140 offsets of the members of Frame and of the tables of looks; constants that the CPU needs
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");

/** The line of a file that defines a constant. */
function constantIn(path, name) {
  const line = new RegExp(`^SHARED_CONST \\w+ ${name} = [^;]+;$`, "m").exec(readFileSync(join(root, path), "utf8"));
  if (!line) throw new Error(`${path} has no constant ${name}`);
  return `${line[0]}\n`;
}

/** Files of the repository that a page has otherwise, by what stands for them. */
const replaced = {
  "shaders/shared/types.h": "",
  // Push constants: a page has one block of uniforms. Of the rest it needs this.
  "shaders/shared/passes.h": constantIn("shaders/shared/passes.h", "bladeShadowSegments"),
  // Nor has it occlusion by the ground.
  "shaders/shared/occlusion.h": "SHARED_BUFFER(DepthPyramid, uint, )\n",
  "shaders/shared/host_light.h": "SHARED_BUFFER(HostLightArray, uint, readonly)\n",
  // Blades lie in textures by their number.
  "shaders/blade/pages.glsl": "uint placeOf(uvec2 pages, uint blade) { return blade; }\n",
};

/** Specialisation constants that differ from their default. */
const specialised = { knownDebugMode: "0u", outputMode: "0u", MAY_BE_PAGED: "false" };

/** Words that GLSL ES reserves, and names that stand for them. */
const reserved = { sample: "sample_", active: "active_", common: "common_", filter: "filter_" };

/** Pieces of files between their includes, by "path:number", without comments. */
const pieces = new Map();

/** Keys of the pieces of a file and of all that it includes, each file once. */
function piecesOf(path, seen = new Set()) {
  if (seen.has(path)) return [];
  seen.add(path);
  const text = (replaced[path] ?? readFileSync(join(root, path), "utf8")).replace(/\/\*[^]*?\*\/|\/\/[^\n]*/g, "");
  const parts = text.split(/^\s*#include "([^"]+)"[^\n]*\n/m);
  return parts.flatMap((part, i) => {
    if (i % 2 === 1) return piecesOf(part, seen);
    if (!/\S/.test(part)) return [];
    pieces.set(`${path}:${i}`, part);
    return [`${path}:${i}`];
  });
}

/** A line without spaces around operators, which takes a thirtieth off the script. Minus keeps them: `a - -b`. */
const tight = (line) => line.replace(/ ([*/+=<>?:]|[-+*/=!<>&|^]=|&&|\|\|) /g, "$1").replace(/, /g, ",");

/** Positions of the bracket that closes the one at `at`. */
function closing(text, at) {
  for (let depth = 0, i = at; i < text.length; ++i) {
    if (text[i] === "[") ++depth;
    else if (text[i] === "]" && --depth === 0) return i;
  }
  throw new Error("a bracket is not closed");
}

/** `X.name.at[i]` becomes a call of the function that reads the table which `name` is. */
function readTables(text, tableOf) {
  for (let from = 0; ; ) {
    const found = /(?:\w+(?:\[\w+\])?\.)*(\w+)\.at\[/.exec(text.slice(from));
    if (!found) return text;
    const begin = from + found.index;
    const open = begin + found[0].length - 1;
    const table = tableOf.get(found[1]);
    if (!table) {
      from = open;
      continue;
    }
    const close = closing(text, open);
    text = `${text.slice(0, begin)}fetch${table}(uint(${text.slice(open + 1, close)}))${text.slice(close + 1)}`;
    from = begin;
  }
}

/** GLSL ES has no constants at run time: `const` stays where braces are closed. */
function withoutLocalConst(text) {
  let depth = 0;
  return text.replace(/[{}]|\bconst /g, (token) => {
    if (token === "{") ++depth;
    else if (token === "}") --depth;
    else return depth > 0 ? "" : token;
    return token;
  });
}

/** The members of Frame in shaders/shared/frame.h. */
let frameBody = "";

/** All pieces in GLSL ES. Tables have one name in all of them, so they are translated together. */
function translate() {
  const tables = [];
  for (const [key, piece] of pieces)
    pieces.set(
      key,
      piece
        .replace(/^\s*#(extension|version)[^\n]*\n/gm, "")
        .replace(/SHARED_(BEGIN|END)\n?/g, "")
        .replace(/SHARED_FN\s+/g, "")
        .replace(/SHARED_UNROLL\s+/g, "")
        .replace(/SHARED_CONST\b/g, "const")
        .replace(/SHARED_INOUT\((\w+)\)/g, "inout $1")
        .replace(/SHARED_LAYOUT\([^)]*\)/g, "")
        .replace(/SHARED_(?:TABLE|BUFFER)\((\w+),\s*(\w+)[^)]*\)/g, (_, name, type) => {
          tables.push(name);
          return `struct ${name} { uint none; };\n${type} fetch${name}(uint i);`;
        })
        .replace(/layout\(constant_id = \w+\)\s*const (\w+) (\w+) = ([^;]+);/g, (_, type, name, value) =>
          `const ${type} ${name} = ${specialised[name] ?? value};`,
        ),
    );
  // The members of structs that are tables, and the names by which functions know tables.
  const names = tables.join("|");
  const tableOf = new Map();
  for (const piece of pieces.values())
    for (const found of piece.matchAll(new RegExp(`\\b(${names})\\s+(\\w+)\\s*[;,)]`, "g")))
      tableOf.set(found[2], found[1]);
  for (const [key, piece] of pieces) {
    let text = piece.replace(/struct (\w+)\s*\{([^}]*)\};/g, (whole, name, body) =>
      tables.includes(name)
        ? whole
        : `struct ${name} {${body.replace(new RegExp(`\\s*(${names})\\s+\\w+;`, "g"), "")}};`,
    );
    text = text
      .replace(/\bFRAME\.organs\b(?!\.)/g, "OrganTable(0u)")
      .replace(/FRAME\.pages/g, "0u")
      // WebGL chooses no structs by ?:.
      .replace(/return ([^;?]+) \? (\w+\([^;:]*\)) : (\w+);/g, "if ($1) return $2; return $3;")
      // A page has no colliders.
      .replace(/environment\.colliderCount > 0u/g, "false")
      .replace(/\benvironment\.colliders\b/g, "ColliderTable(0u)");
    text = readTables(text, tableOf);
    for (const [word, name] of Object.entries(reserved))
      text = text.replace(new RegExp(`\\b${word}\\b`, "g"), name);
    text = withoutLocalConst(text);
    // The struct itself becomes the block of uniforms.
    const frame = /struct Frame\s*\{([^}]*)\};/.exec(text);
    if (frame) {
      frameBody = frame[1];
      text = text.replace(frame[0], "").replace("Frame fetchFrameArray(uint i);", "");
    }
    text = text.replace("MEMBERS_OF_FRAME", () => frameBody);
    text = text.replace(/[ \t]+$/gm, "").replace(/\n{2,}/g, "\n").replace(/^[ \t]+/gm, "").trimStart();
    pieces.set(key, text.replace(/^[^#\n].*$/gm, tight));
  }
}

const stages = [
  "move.vert", "move.frag", "pose.vert", "blade.vert", "blade.frag", "ground.vert", "ground.frag", "sky.vert",
  "sky.frag", "film.vert", "film.frag", "sun.vert", "blade_shadow.vert", "blade_shadow.frag", "nothing.frag",
  "host_blade.frag", "host_ground.frag",
];

const head =
  "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n" +
  "precision highp usampler2D;\n";

/** std140 offsets of all leaves of a struct, by path. */
function layoutOf(text, name) {
  const constants = new Map();
  for (const [, key, value] of text.matchAll(/^const (?:uint|int|float) (\w+) ?= ?([^;]+);/gm))
    constants.set(key, value);
  const number = (expression) => {
    const plain = expression.replace(/\b(\d+)u\b/g, "$1").replace(/[a-zA-Z]\w*/g, (key) => number(constants.get(key)));
    return Number(new Function(`return ${plain}`)());
  };
  const structs = new Map();
  for (const [, key, body] of text.matchAll(/struct (\w+)\s*\{([^}]*)\};/g))
    structs.set(
      key,
      [...body.matchAll(/(\w+)\s+(\w+)(?:\[([^\]]+)\])?;/g)].map(([, type, member, size]) => ({
        type,
        member,
        count: size === undefined ? 0 : number(size),
      })),
    );
  const basic = {
    float: [4, 4], uint: [4, 4], int: [4, 4], bool: [4, 4], vec2: [8, 8], uvec2: [8, 8],
    vec3: [16, 12], uvec3: [16, 12], vec4: [16, 16], uvec4: [16, 16], mat4: [16, 64],
  };
  const up = (at, to) => Math.ceil(at / to) * to;
  const sizeOf = (type) => {
    if (basic[type]) return { align: basic[type][0], size: basic[type][1] };
    return { align: 16, size: up(place(type, "", 0, null), 16) };
  };
  /** Places the members of a struct from `at` on; returns the end. */
  function place(type, prefix, at, leaves) {
    if (!structs.has(type)) throw new Error(`no struct ${type}`);
    for (const { type: own, member, count } of structs.get(type)) {
      const { align, size } = sizeOf(own);
      const stride = up(size, 16);
      at = up(at, count > 0 ? 16 : align);
      for (let i = 0; i < Math.max(count, 1); ++i) {
        const path = `${prefix}${member}${count > 0 ? `[${i}]` : ""}`;
        if (leaves && basic[own]) leaves[path] = at;
        else if (leaves) place(own, `${path}.`, at, leaves);
        at += count > 0 ? stride : size;
      }
    }
    return at;
  }
  const leaves = {};
  const size = up(place(name, "", 0, leaves), 16);
  return { size, leaves, constants };
}

/** Constants of the shared headers that TypeScript needs. */
const exported = [
  "lodFullShare", "maxWindSources", "windNoise", "windWave", "windsAlike", "latticeX", "latticeY", "latticeZ",
  "fineNoiseScale", "fineNoiseStart", "unsettledTurn", "maxHeightCompensation", "outlineMost", "heightSteps",
  "bladeShadowTexels", "bladeShadowSegments", "cullPatch", "cullOrientation", "cullFrustum", "cullDistance", "leaveThinned", "toneBits",
  "shapeCount",
];

/** Writes the two files into a folder, unless that is null; returns the texts of all stages by their names. */
export function generate(output = join(here, "src/generated")) {
  if (output) mkdirSync(output, { recursive: true });
  const parts = new Map(stages.map((stage) => [stage, piecesOf(`web/shaders/${stage}`)]));
  translate();
  const keys = [...pieces.keys()];
  const texts = {};
  const lines = ["// Written by generate.mjs.\n", "const pieces = ["];
  for (const key of keys) lines.push(`  // ${key.replace(/:\d+$/, "")}`, `  ${JSON.stringify(pieces.get(key))},`);
  lines.push("];\n", `const head = ${JSON.stringify(head)};\n`);
  lines.push("/** The text of a stage out of its pieces. */");
  lines.push("const stage = (...numbers: number[]) => head + numbers.map((i) => pieces[i]).join(\"\");\n");
  for (const [name, own] of parts) {
    texts[name] = head + own.map((key) => pieces.get(key)).join("");
    const numbers = own.map((key) => keys.indexOf(key)).join(", ");
    lines.push(`export const ${name.replace(/[._](\w)/g, (_, c) => c.toUpperCase())} = stage(${numbers});`);
  }
  if (output) writeFileSync(join(output, "shaders.ts"), `${lines.join("\n")}\n`);
  const frame = layoutOf(`${texts["pose.vert"]}struct Frame {${frameBody}};`, "Frame");
  const looks = layoutOf(texts["pose.vert"], "Looks");
  const values = exported.map((name) => {
    const text = frame.constants.get(name);
    if (text === undefined) throw new Error(`no constant ${name}`);
    const plain = text.replace(/\b(0x[0-9a-f]+|\d+)u\b/g, "$1").replace(/(\d)f\b/g, "$1");
    const value = Number(new Function(`return ${plain}`)());
    // Words of 32 bits are unsigned.
    return `export const ${name} = ${Number.isInteger(value) ? value >>> 0 : plain};`;
  });
  if (!output) return texts;
  writeFileSync(
    join(output, "layout.ts"),
    `// Written by generate.mjs.\n\n${values.join("\n")}\n\n` +
      ["frame", "looks"].map((name) => {
        const layout = { frame, looks }[name];
        return (
          `export const ${name}Bytes = ${layout.size};\n` +
          `export const ${name}Layout: Record<string, number> = ${JSON.stringify(layout.leaves)};\n`
        );
      }).join("\n"),
  );
  return texts;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) generate();
