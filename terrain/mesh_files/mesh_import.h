#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <filesystem>

namespace sward::terrain {

/// Reads an OBJ, PLY, STL or OFF file, all but OBJ by OpenMesh's readers. Polygons become fans;
/// non-manifold faces are kept. Coordinates are in file units, in double precision where the file
/// has it; else `metresPerUnit` is used for a warning. Not reentrant: OpenMesh's readers are
/// shared. Vertex colours are stored as images are (GroundMaterial::srgbColors). Notes parts
/// without what masks `read`. Throws Error{io, input, unsupported}.
Soup importMesh(const std::filesystem::path& path, const MaskInputs& read, double metresPerUnit,
                Diagnostics& diagnostics);

} // namespace sward::terrain
