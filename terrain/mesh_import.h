#pragma once

#include "core/diagnostics.h"
#include "terrain/soup.h"

#include <filesystem>

namespace sward::terrain {

/// Reads an OBJ, PLY, STL or OFF file through OpenMesh's readers, faces as they are: polygons
/// become fans, nothing is dropped for not being manifold. Coordinates are those of the file.
/// Throws Error{io, input}.
Soup importMesh(const std::filesystem::path& path, Diagnostics& diagnostics);

} // namespace sward::terrain
