#pragma once

#include "terrain/soup.h"

#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Reads the text of an OBJ: positions in double precision, colours behind them, a normal and
/// texture coordinates per corner, objects and groups as nodes, materials by name. Faces of less
/// than three corners are passed over. What stands behind each mtllib goes to `libraries`. Not
/// OpenMesh's reader, which stops the program at some faces. Throws Error{input} naming the line.
Soup readObj(std::string_view file, const std::string& place, std::vector<std::string>& libraries);

} // namespace sward::terrain
