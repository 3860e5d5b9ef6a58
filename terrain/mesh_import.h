#pragma once

#include "core/diagnostics.h"
#include "terrain/soup.h"

#include <filesystem>

namespace sward::terrain {

/// Reads an OBJ, PLY, STL or OFF file, all but OBJ through OpenMesh's readers, faces as they are:
/// polygons become fans, nothing is dropped for not being manifold. Coordinates are those of the
/// file, in double precision where it has them; `metresPerUnit` is for a warning where it has not.
/// One at a time: OpenMesh's readers are shared. Throws Error{io, input, unsupported}.
Soup importMesh(const std::filesystem::path& path, double metresPerUnit, Diagnostics& diagnostics);

} // namespace sward::terrain
