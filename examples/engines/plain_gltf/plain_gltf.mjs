// Turns a field exported as .glb into plain glTF without extensions, one mesh for each species, for programs that do not
// know EXT_mesh_gpu_instancing. About 600 bytes a blade: for some ten thousand blades.
//
//   npm install @gltf-transform/core@4 @gltf-transform/extensions@4 @gltf-transform/functions@4
//   sward export meadow.sward -o meadow.glb && node plain_gltf.mjs meadow.glb plain.glb
import { NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { clearNodeTransform, flatten, join, prune, uninstance } from "@gltf-transform/functions";

const [input, output] = process.argv.slice(2);
if (!output) {
  console.error("usage: node plain_gltf.mjs IN.glb OUT.glb");
  process.exit(1);
}
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
const document = await io.read(input);
// Places stay relative to the field's origin: the root's translation would take the millimetres from far vertices.
document.getRoot().getDefaultScene().listChildren()[0].setTranslation([0, 0, 0]);
await document.transform(uninstance(), flatten(), join({ keepNamed: false, keepMeshes: false }), prune());
for (const node of document.getRoot().listNodes()) {
  clearNodeTransform(node);
  node.setName(node.getMesh()?.getName() ?? "").setExtras({}); // they are those of one blade
}
await io.write(output, document);
