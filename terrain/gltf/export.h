#pragma once

#include "terrain/ground_mesh.h"

#include <filesystem>

namespace sward::terrain {

/// Writes `mesh` as a binary glTF: a node per node of the mesh, placed at its origin, a primitive
/// per material, images as PNG. The same mesh gives the same bytes. Throws Error{io}.
void exportGltf(const GroundMesh& mesh, const std::filesystem::path& path, bool overwrite);

} // namespace sward::terrain
