#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <filesystem>

namespace sward::terrain {

/// Reads an OBJ, PLY, STL or OFF file. Polygons become triangles; non-manifold faces are kept.
/// Coordinates are in file units, in double precision where the file has it; else `metresPerUnit`
/// is used for a warning. Vertex colours are stored as images are (GroundMaterial::srgbColors).
/// Notes parts without what masks `read`. Throws Error{io, input}.
Soup importMesh(const std::filesystem::path& path, const MaskInputs& read, double metresPerUnit,
                Diagnostics& diagnostics);

} // namespace sward::terrain
