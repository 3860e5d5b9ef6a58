// Bundles the package: src/index.ts with fzstd becomes dist/sward.js, an ES module. Names and lines remain, so that people can
// read what a page runs. `node build.mjs [FOLDER]` writes elsewhere, for the test that compares it with dist/.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { generate } from "./generate.mjs";
import { generateWgsl } from "./generate_wgsl.mjs";

const here = dirname(fileURLToPath(import.meta.url));

generate();
generateWgsl();
await build({
  absWorkingDir: here,
  entryPoints: ["src/index.ts"],
  bundle: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  // Shorter statements, but names and lines remain.
  minifySyntax: true,
  legalComments: "inline",
  // Comments in the script name files: node_modules may lie elsewhere.
  preserveSymlinks: true,
  banner: {
    js:
      "// Built from web/src by `npm run build`; do not edit.\n" +
      "// Sward, MIT licence. Contains fzstd, MIT licence, copyright (c) 2020 Arjun Barrett.",
  },
  outfile: join(process.argv[2] ?? join(here, "dist"), "sward.js"),
});
