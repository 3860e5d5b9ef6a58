#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf_materials.h"
#include "terrain/gltf_model.h"
#include "terrain/soup.h"

#include <string>
#include <vector>

namespace sward::terrain {

/// At most so much is in a mesh, by the counts of its accessors.
struct GltfMeshSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};
GltfMeshSize sizeOfGltfMesh(const GltfModel& model, std::size_t mesh);

/// Appends the triangles of a mesh to `soup`, all its primitives, in the mesh's own space. Points
/// and lines are passed over with a warning. Materials are numbered as importGltfMaterials() does.
/// Throws Error{input} naming mesh, primitive and vertex.
void readGltfMesh(const GltfModel& model, std::size_t mesh, const std::vector<GltfUvSource>& uvs,
                  const std::string& place, Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
