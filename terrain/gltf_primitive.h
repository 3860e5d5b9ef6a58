#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf_materials.h"
#include "terrain/soup.h"

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace sward::terrain {

/// Reads the triangles of a mesh, all its primitives in one, in the mesh's own space. Points and
/// lines are passed over with a warning. Materials are numbered as importGltfMaterials() does.
/// Throws Error{input} naming mesh, primitive and vertex.
Soup readGltfMesh(const tinygltf::Model& model, std::size_t mesh,
                  const std::vector<GltfUvSource>& uvs, const std::string& place,
                  Diagnostics& diagnostics);

} // namespace sward::terrain
