// Prints a USD layer as TinyUSDZ has understood it: node read_usd.mjs MODULES FILE
// Its WebAssembly is built for browsers, so it is told that this is one.
import fs from "fs";

const [modules, file] = process.argv.slice(2);
process.type = "renderer";
globalThis.window = globalThis;
globalThis.location = { href: "file:///" };
globalThis.document = { currentScript: null, baseURI: "file:///" };
// It is a module, but its package does not say so, which Node 18 demands.
const source = fs.readFileSync(`${modules}/tinyusdz/tinyusdz.js`, "utf8")
  .replaceAll("import.meta.url", '"file:///tinyusdz.js"');
const url = `data:text/javascript;base64,${Buffer.from(source).toString("base64")}`;
const make = (await import(url)).default;
const usd = await make({ wasmBinary: fs.readFileSync(`${modules}/tinyusdz/tinyusdz.wasm`) });

const bytes = new Uint8Array(fs.readFileSync(file));
const layer = new usd.TinyUSDZLoaderNative();
const stage = new usd.TinyUSDZLoaderNative();
// A layer is text that parses; a stage has its references followed and its meshes converted.
if (!layer.loadAsLayerFromBinary(bytes, "layer.usda") || !stage.loadFromBinary(bytes, "layer.usda")) {
  console.error(`TinyUSDZ refuses ${file}: ${layer.error()} ${stage.error()}`);
  process.exit(1);
}
fs.writeSync(2, `${stage.numMeshes()} meshes\n`);
process.stdout.write(layer.layerToString());
