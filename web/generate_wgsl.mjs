// Makes WGSL of the shaders in shaders/, and of the thin stages in web/shaders/webgpu, by web/wgsl. Writes
// src/generated/wgsl.ts: the text of each stage out of pieces that stages share, the bindings that each has, and the
// places of the members of structs that TypeScript fills.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { emit, Names } from "./wgsl/emit.mjs";
import { placesIn } from "./wgsl/layout.mjs";
import { parse, preprocess } from "./wgsl/parse.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..");

/** Files of the repository that a page has otherwise, by what stands for them. */
const replaced = {
  // Macros stand for it.
  "shaders/shared/types.h": "",
  // Blades lie in a buffer by their number.
  "shaders/blade/pages.glsl": "uint placeOf(uvec2 pages, uint blade) { return blade; }\n",
};
const moved = { "shaders/raster/put_sample.glsl": "web/shaders/webgpu/put_sample.glsl" };

/** Texts that are otherwise in a page, by files. */
const changes = {
  // FRAME has no pyramid in WebGL; the push has it here.
  "shaders/shared/occlusion.h": [[/struct DepthPyramid \{[^}]*\};\s*SHARED_LAYOUT\(DepthPyramid, \d+\)/, "SHARED_BUFFER(DepthPyramid, uint, )"]],
  "shaders/cull/hidden.glsl": [
    [/uvec2\(PYRAMID\.depths\) == uvec2\(0u\)/g, "PYRAMID.levels == 0u"],
    [/CULL_VIEW\.pyramid/, "push.pyramid"],
    [/CULL_VIEW\./g, "FRAME."],
  ],
  "shaders/cull/behind_pyramid.glsl": [[/PYRAMID\.depths/g, "PYRAMID.cells"]],
  // A page has no colliders.
  "shaders/shared/physics.h": [[/environment\.colliderCount > 0u/g, "false"]],
};

function read(path) {
  let text = replaced[path] ?? readFileSync(join(root, moved[path] ?? path), "utf8");
  for (const [from, to] of changes[path] ?? []) {
    if (text.search(from) < 0) throw new Error(`${path} does not have ${from}`);
    text = text.replace(from, to);
  }
  return text;
}

const macros = {
  SHARED_BEGIN: [null, ""],
  SHARED_END: [null, ""],
  SHARED_FN: [null, ""],
  SHARED_CONST: [null, "const"],
  SHARED_UNROLL: [null, ""],
  SHARED_INOUT: [["T"], "inout T"],
  SHARED_LAYOUT: [["T", "bytes"], ""],
  SHARED_TABLE: [["N", "T"], "table N T;"],
  SHARED_BUFFER: [["N", "T", "access"], "table N T;"],
  MAY_BE_PAGED: [null, "false"],
};

/** Specialisation constants that differ from their default. */
const constants = { knownDebugMode: "0u", outputMode: "0u", samplesPerPixel: "4u" };
/** Those that a pipeline gives. */
const overrides = ["mayFold", "mayHaveOrgans", "onlyShape"];

/** Stages by their name: file, and what differs. */
export const stages = {
  walk: { file: "walk.comp" },
  arguments: { file: "arguments.comp" },
  update: { file: "update.comp" },
  raster: { file: "raster.comp" },
  rasterQuads: { file: "raster_quads.comp" },
  shadow: { file: "shadow.comp", constants: { samplesPerPixel: "1u" } },
  raster64: { file: "raster.comp", has64: true },
  rasterQuads64: { file: "raster_quads.comp", has64: true },
  shadow64: { file: "shadow.comp", has64: true, constants: { samplesPerPixel: "1u" } },
  seed: { file: "seed.comp" },
  resolve: { file: "resolve.comp" },
  records: { file: "records.comp" },
  groundVertex: { file: "ground.vert" },
  groundFragment: { file: "ground.frag" },
  sunVertex: { file: "sun.vert" },
  filmVertex: { file: "film.vert" },
  filmFragment: { file: "film.frag" },
};

const kinds = { comp: "compute", vert: "vertex", frag: "fragment" };

/** All stages: { name: { head, pieces, resources } }. */
export function translate() {
  const names = new Names();
  const done = {};
  for (const [name, how] of Object.entries(stages)) {
    const defined = how.has64 ? { ...macros, HAS_ATOMIC64: [null, ""] } : macros;
    const tokens = preprocess(`web/shaders/webgpu/${how.file}`, read, defined);
    const stage = kinds[how.file.split(".")[1]];
    const made = emit(parse(tokens), { stage, names, overrides, constants: { ...constants, ...how.constants } });
    done[name] = { head: how.has64 ? "enable atomic_vec2u_min_max;\n" : "", ...made };
  }
  return done;
}

/** Structs whose members TypeScript places, and a stage that has them. Frame and Looks have the places of layout.ts. */
const placed = { Push: "resolve", Material: "groundFragment", Patch: "update" };

/**
 * Text without spaces around operators, as in generate.mjs. Divisions keep them, since a division by `*p` would begin a
 * comment, and so does what follows `>`, which may end a template.
 */
const tight = (text) => text.replace(/(?<!>) ([*+=:]|[-+*=!&|^]=|&&|\|\|) /g, "$1").replace(/, /g, ",");

/** Writes src/generated/wgsl.ts, unless `output` is null; returns the texts of all stages by their names. */
export function generateWgsl(output = join(here, "src/generated")) {
  const done = translate();
  const pool = new Map();
  const texts = {};
  const lines = [];
  for (const [name, { head, pieces: loose, resources }] of Object.entries(done)) {
    const pieces = loose.map(tight);
    texts[name] = `${head}${pieces.join("\n")}\n`;
    const own = pieces.map((piece) => {
      if (!pool.has(piece)) pool.set(piece, pool.size);
      return pool.get(piece);
    });
    lines.push(`  ${name}: { head: ${JSON.stringify(head)}, pieces: [${own.join(", ")}], resources: ${JSON.stringify(resources)} as Record<string, number> },`);
  }
  if (!output) return texts;
  mkdirSync(output, { recursive: true });
  const places = Object.entries(placed).map(([struct, stage]) => {
    const { size, members } = placesIn(done[stage].pieces, struct);
    return `  ${struct}: { size: ${size}, members: ${JSON.stringify(members)} as Record<string, number> },`;
  });
  writeFileSync(
    join(output, "wgsl.ts"),
    `// Written by generate_wgsl.mjs.\n\n/** Declarations that stages are made of. */\nexport const pieces: readonly string[] = [\n` +
      `${[...pool.keys()].map((piece) => `  ${JSON.stringify(piece)},`).join("\n")}\n];\n\n` +
      `/** Stages: declarations by their numbers, and bindings of group 0. */\nexport const stages = {\n${lines.join("\n")}\n};\n\n` +
      `/** Places of members [bytes]. */\nexport const places = {\n${places.join("\n")}\n};\n`,
  );
  return texts;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) generateWgsl();
