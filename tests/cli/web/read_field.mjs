// Reads fields by web/dist/sward.js for web_test.py.
//   node read_field.mjs rows FILE|ADDRESS      f64 rows on stdout: the columns of the CSV export, without ribbons
//   node read_field.mjs errors FILE|ADDRESS …  JSON: for each {"kind", "message"} of the error, or {} if there is none
//   node read_field.mjs covers FIELD COVER …   the same for covers of a field
//   node read_field.mjs pages ADDRESS FROM TO  JSON: bytes received before and after these pages, and which are here
//   node read_field.mjs hash                   one number a line: XXH3 of the bytes i·i mod 251, for lengths on stdin
import { readFileSync, writeSync } from "node:fs";
import { fileURLToPath } from "node:url";

const script = fileURLToPath(new URL("../../../web/dist/sward.js", import.meta.url));
const { checkCover, openField, parseCoverFile, readField, SwardError, xxh3 } = await import(script);

const [what, place, from, to] = process.argv.slice(2);

async function opened(place) {
  if (!place.startsWith("http:")) return readField(new Uint8Array(readFileSync(place)), place);
  const field = await openField(place);
  await field.loadAll();
  await field.loadKeys();
  return field;
}

/** All bytes: a pipe takes them in parts. */
function write(bytes) {
  for (let at = 0; at < bytes.length; ) {
    try {
      at += writeSync(1, bytes, at);
    } catch (error) {
      if (error.code !== "EAGAIN") throw error;
    }
  }
}

function rowsOf(field) {
  const blades = field.blades();
  const rows = [];
  for (let i = 0; i < blades.count; ++i) {
    if (field.isRibbon(i)) continue;
    const root = [0, 1, 2].map((axis) => field.origin[axis] + blades.root[3 * i + axis]);
    rows.push(
      Number(field.idOf(i)), ...root, ...blades.up.subarray(3 * i, 3 * i + 3), blades.facing[i],
      blades.height[i], blades.width[i], blades.stiffness[i], blades.species[i], blades.exposure[i],
      ...blades.tint.subarray(3 * i, 3 * i + 3), blades.clump[i], blades.patch[i],
    );
  }
  return new Uint8Array(Float64Array.from(rows).buffer);
}

if (what === "rows") write(rowsOf(await opened(place)));
else if (what === "errors" || what === "covers") {
  const found = [];
  const isCover = what === "covers";
  const field = isCover ? await opened(place) : undefined;
  const covers = async (file) => checkCover(field, parseCoverFile(Uint8Array.from(readFileSync(file)).buffer, file));
  for (const one of process.argv.slice(isCover ? 4 : 3))
    await (isCover ? covers(one) : opened(one)).then(
      () => found.push({}),
      (error) => {
        if (!(error instanceof SwardError)) throw error;
        found.push({ kind: error.kind, message: error.message });
      },
    );
  console.log(JSON.stringify(found));
} else if (what === "pages") {
  const field = await openField(place);
  const before = field.received;
  await field.loadPages(Number(from), Number(to));
  console.log(
    JSON.stringify({
      before,
      after: field.received,
      pages: field.pageCount,
      here: field.presentPages,
      has: field.has(1024 * Number(from), 1),
      patches: field.patches.count,
    }),
  );
} else {
  for (const length of readFileSync(0, "ascii").trim().split("\n").map(Number))
    console.log(xxh3(Uint8Array.from({ length }, (_, i) => (i * i) % 251)).toString());
}
