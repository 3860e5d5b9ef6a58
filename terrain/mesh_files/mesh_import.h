#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace sward::terrain {

/// Reads an OBJ, PLY, STL or OFF file. Polygons become triangles; non-manifold faces are kept.
/// Coordinates are in file units, in double precision where the file has it; else `metresPerUnit`
/// is used for a warning. Vertex colours are stored as images are (GroundMaterial::srgbColors).
/// Notes parts without what masks `read`. Throws Error{io, input}.
Soup importMesh(const std::filesystem::path& path, const MaskInputs& read, double metresPerUnit,
                Diagnostics& diagnostics);

/// Warns of coordinates of single precision that resolve less than 0.1 mm.
void warnOfCoarseness(const std::vector<glm::dvec3>& positions, double metresPerUnit,
                      const std::string& place, Diagnostics& diagnostics);

/// Difference of neighbouring coordinates: the last decimal of a text, or that of single or double
/// precision.
double coordinateStep(const std::vector<glm::dvec3>& positions, bool isText);

/// Lets vertex colours, if there are any, be the colour of all materials that have none.
void showColors(Soup& soup);

} // namespace sward::terrain
