// Writes a .glb without compression, decoded by meshoptimizer's own decoder: node unpack_meshopt.mjs MODULES FILE
// Checks what EXT_meshopt_compression and KHR_meshopt_compression say of views and fallback buffers.
import fs from "fs";

const [modules, file] = process.argv.slice(2);
const { MeshoptDecoder } = await import(`${modules}/three/examples/jsm/libs/meshopt_decoder.module.js`);
await MeshoptDecoder.ready;

const demand = (law, text) => {
  if (law) return;
  console.error(`${file}: ${text}`);
  process.exit(1);
};
const bytes = fs.readFileSync(file);
const jsonBytes = bytes.readUInt32LE(12);
const json = JSON.parse(bytes.subarray(20, 20 + jsonBytes).toString());
const binary = bytes.subarray(20 + jsonBytes + 8);
const names = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
const used = names.filter((name) => json.extensionsUsed.includes(name));
demand(used.length === 1 && json.extensionsRequired.includes(used[0]), "names no extension, or several");
const [name] = used;

const parts = [];
let end = 0;
const append = (part) => {
  const offset = end;
  parts.push(part, Buffer.alloc((4 - (part.length % 4)) % 4));
  end += Math.ceil(part.length / 4) * 4;
  return offset;
};
let fallback = 0;
let stored = 0;
for (const view of json.bufferViews) {
  const packed = view.extensions?.[name];
  if (!packed) {
    demand(view.buffer === 0, "a plain view lies in the fallback buffer");
    view.byteOffset = append(binary.subarray(view.byteOffset, view.byteOffset + view.byteLength));
    continue;
  }
  demand(view.buffer === 1 && packed.buffer === 0, "buffers of a compressed view");
  demand(view.byteLength === packed.byteStride * packed.count, "byteLength is not byteStride times count");
  demand(packed.byteStride % 4 === 0 && packed.byteStride <= 256, `byteStride is ${packed.byteStride}`);
  demand(packed.mode === "ATTRIBUTES", `mode is ${packed.mode}`);
  demand(view.byteOffset >= fallback && view.byteOffset % 4 === 0, "views of the fallback buffer overlap");
  fallback = view.byteOffset + view.byteLength;
  const target = new Uint8Array(view.byteLength);
  const source = binary.subarray(packed.byteOffset, packed.byteOffset + packed.byteLength);
  demand(source[0] === 0xa0, `the stream's header is ${source[0]}`);
  demand(packed.byteOffset >= stored, "streams overlap");
  stored = packed.byteOffset + packed.byteLength;
  MeshoptDecoder.decodeGltfBuffer(target, packed.count, packed.byteStride, source, packed.mode, packed.filter);
  view.buffer = 0;
  view.byteOffset = append(Buffer.from(target.buffer));
  delete view.extensions;
}
demand(json.buffers.length === 2 && json.buffers[1].extensions[name].fallback === true && !("uri" in json.buffers[1]),
  "no fallback buffer");
demand(json.buffers[1].byteLength >= fallback, "the fallback buffer is too short");
demand(stored <= json.buffers[0].byteLength && json.buffers[0].byteLength <= binary.length, "the buffer is too short");
json.buffers = [{ byteLength: end }];
for (const list of ["extensionsUsed", "extensionsRequired"]) json[list] = json[list].filter((one) => one !== name);

const text = Buffer.from(JSON.stringify(json));
const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
const head = Buffer.alloc(20);
head.write("glTF", 0, "ascii");
[2, 12 + 8 + padded.length + 8 + end, padded.length, 0x4e4f534a].forEach((word, i) => head.writeUInt32LE(word, 4 + 4 * i));
const binHead = Buffer.alloc(8);
binHead.writeUInt32LE(end, 0);
binHead.writeUInt32LE(0x004e4942, 4);
fs.writeFileSync(1, Buffer.concat([head, padded, binHead, ...parts]));
