#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::bake {

/// Orthonormal frame of a smooth region. Local coordinates are in cells of a DiskMap, a third of a
/// spacing wide; z points along the region's mean normal.
struct RegionFrame {
    glm::dvec3 origin{0.0};
    glm::dmat3 axes{1.0};  ///< rows of length 1 / cell
    glm::ivec2 cells{0};   ///< columns and rows of the map
    double spacing = 1.0;  ///< [m]
    double rounding = 0.0; ///< [m] largest rounding error of a position

    glm::dvec3 vector(const glm::dvec3& v) const { return axes * v; }
    glm::dvec3 place(const glm::dvec3& p) const { return axes * (p - origin); }
};

} // namespace sward::bake
