// Writes each instance that three.js shows, as seventeen doubles: _ROOT_ID, or 0 without it, and its matrix in
// the world, column by column: node read_instances.mjs MODULES FILE. Says on stderr how long loading took.
import fs from "fs";

const [modules, file] = process.argv.slice(2);
globalThis.self = globalThis;
const { Matrix4 } = await import(`${modules}/three/build/three.module.js`);
const { GLTFLoader } = await import(`${modules}/three/examples/jsm/loaders/GLTFLoader.js`);
const { MeshoptDecoder } = await import(`${modules}/three/examples/jsm/libs/meshopt_decoder.module.js`);

const bytes = fs.readFileSync(file);
const content = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const begin = performance.now();
const { scene, parser } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(content, "");
console.error(`${performance.now() - begin} ms`);
scene.updateMatrixWorld(true);
const shown = [];
scene.traverse((object) => object.isInstancedMesh && shown.push(object));

const rows = [];
const matrix = new Matrix4();
for (const mesh of shown) {
  // The loader puts attributes of one's own into the geometry, which all nodes of a species share;
  // those of this node are in the file.
  const node = parser.json.nodes[parser.associations.get(mesh).nodes];
  const attributes = node.extensions.EXT_mesh_gpu_instancing.attributes;
  const id = "_ROOT_ID" in attributes && await parser.getDependency("accessor", attributes._ROOT_ID);
  for (let i = 0; i < mesh.count; ++i) {
    mesh.getMatrixAt(i, matrix);
    matrix.premultiply(mesh.matrixWorld);
    rows.push(id && id.getX(i) + id.getY(i) * 2 ** 16 + id.getZ(i) * 2 ** 32 + id.getW(i) * 2 ** 48,
              ...matrix.elements);
  }
}
fs.writeFileSync(1, new Uint8Array(new Float64Array(rows).buffer));
