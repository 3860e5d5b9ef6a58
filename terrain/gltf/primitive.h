#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/materials.h"
#include "terrain/gltf/model.h"
#include "terrain/gltf/pose.h"
#include "terrain/topology/soup.h"

#include <string>
#include <vector>

namespace sward::terrain {

/// Upper bounds of a mesh's size, from its accessors' counts.
struct GltfMeshSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};
GltfMeshSize sizeOfGltfMesh(const GltfModel& model, std::size_t mesh);

/// Appends the triangles of all primitives of a mesh to `soup`, posed, in the mesh's space, or in
/// the scene's if `pose` has a skin. Skips points and lines with a warning. Numbers materials as
/// importGltfMaterials() does. Keeps the attributes that masks `read`. Throws Error{input} naming
/// mesh, primitive and vertex.
void readGltfMesh(const GltfModel& model, std::size_t mesh, const GltfPose& pose,
                  const std::vector<GltfUvSource>& uvs, const MaskInputs& read,
                  const std::string& place, Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
