// Sows all units of a field with seeds by web/dist/sow.wasm and compares them with the field that `sward grow` writes
// of it: node sow_units.mjs SEEDS GROWN prints JSON: blades that are stored or sown, and those of them whose packed
// bytes, or whose patch's steps, differ; units; patches that do not hold their blades.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const dist = fileURLToPath(new URL("../../../web/dist/", import.meta.url));
const { bladeId, compileSower, numbersOf, pagesOf, readField, SowModule, unpackFrame } = await import(`${dist}sward.js`);

const [seedsFile, grownFile] = process.argv.slice(2);
const [field, grown] = await Promise.all([seedsFile, grownFile].map((name) => readField(readFileSync(name), name)));

const patchWords = 26;
const steps = [8, 9, 10, 11, 16, 17, 18, 19]; // rootLow, rootStep, height and width
const known = new Map();
const packed = grown.packed;
for (let p = 0; p < grown.patches.count; ++p) {
  const at = patchWords * p;
  for (let i = 0; i < grown.patches.bladeCount(p); ++i) {
    const blade = grown.patches.firstBlade(p) + i;
    known.set(String(grown.idOf(blade)), [...packed.subarray(4 * blade, 4 * blade + 4), ...steps.map((w) => grown.patches.words[at + w])].join());
  }
}

const module = new SowModule(await compileSower(readFileSync(`${dist}sow.wasm`), "sow.wasm"), seedsFile);
module.begin(numbersOf(field.seeds.meadow, field.species, field.origin), field.seeds.entries);
const found = { all: known.size, sown: 0, different: 0, units: 0, unbounded: 0, again: 0, pages: 0, torn: 0 };
const seen = new Set();
const { levels } = field.seeds.meadow;

/** Cuts a unit into pages and counts blades that are not in the same order there. */
function checkPages(unit) {
  const pages = pagesOf(unit);
  found.pages += pages.count;
  const words = [];
  pages.patchCounts.forEach((count, page) => {
    for (let p = page === 0 ? 1 : 0; p < count; ++p) {
      const at = patchWords * (64 * page + p);
      const first = 2048 * page + pages.patches[at + 3];
      words.push(...pages.blades.subarray(4 * first, 4 * (first + pages.patches[at + 7])));
    }
  });
  if (words.join() !== unit.blades.join()) ++found.torn;
}

for (let cell = 0; cell < field.seeds.count; ++cell) {
  module.openCell(cell, unpackFrame(await field.seeds.frame(cell), undefined, "a cell"));
  for (let level = 0; level <= levels; ++level) {
    const side = 2 ** Math.min(Math.max(level, 3) - 3, 4);
    for (let number = 0; number < side ** 3; ++number)
      for (let half = level === 0 ? 1 : 0; half < 2; ++half) {
        const place = [number % side, Math.floor(number / side) % side, Math.floor(number / side / side)];
        const unit = module.grow({ cell, level, half, place });
        if (unit.blades.length === 0) continue;
        ++found.units;
        checkPages(unit);
        const floats = new Float32Array(unit.patches.buffer);
        for (let at = 0; at < unit.patches.length; at += patchWords) {
          const first = unit.patches[at + 3];
          for (let blade = first; blade < first + unit.patches[at + 7]; ++blade) {
            const id = String(bladeId(unit.keys, blade));
            if (seen.has(id)) ++found.again;
            seen.add(id);
            const own = [...unit.blades.subarray(4 * blade, 4 * blade + 4), ...steps.map((w) => unit.patches[at + w])].join();
            if (known.get(id) !== own) ++found.different;
            const root = [0, 1, 2].map((k) => {
              const bits = k === 0 ? unit.blades[4 * blade] & 65535 : k === 1 ? unit.blades[4 * blade] >>> 16 : unit.blades[4 * blade + 1] & 65535;
              return floats[at + 8 + k] + floats[at + 11] * bits;
            });
            if (root.some((x, k) => x < floats[at + k] || x > floats[at + 4 + k])) ++found.unbounded;
          }
        }
      }
  }
  module.closeCell(cell);
}
found.sown = seen.size;
console.log(JSON.stringify(found));
