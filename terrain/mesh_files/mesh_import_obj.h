#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Reads the text of an OBJ: positions in double precision, colours after them, normals and texture
/// coordinates per corner, objects and groups as nodes, materials by name. Appends the text of each
/// mtllib to `libraries`. Warns of faces of fewer than three corners, which are left out, of
/// polygons whose edges cross, and of corners that name normals or texture coordinates which are
/// not there: these faces are kept without them. Notes objects without what masks `read`. Throws
/// Error{input} naming the line.
Soup readObj(std::string_view file, const std::string& place, const MaskInputs& read,
             std::vector<std::string>& libraries, Diagnostics& diagnostics);

} // namespace sward::terrain
