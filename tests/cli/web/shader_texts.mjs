// Compares the shaders in web/dist/sward.js with what web/generate.mjs makes of the repository's: names of stages that
// differ, as JSON. Writes those of the repository into a folder.
import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { shaders } from "../../../web/dist/sward.js";
import { generate } from "../../../web/generate.mjs";

const folder = process.argv[2];
const different = [];
for (const [name, text] of Object.entries(generate(null))) {
  writeFileSync(join(folder, name), text);
  if (shaders[name.replace(/[._](\w)/g, (_, c) => c.toUpperCase())] !== text) different.push(name);
}
console.log(JSON.stringify(different));
