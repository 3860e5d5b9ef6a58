#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <functional>

namespace sward::terrain {

/// A regular grid of heights around the world's origin, in the x-z plane.
struct HeightGrid {
    glm::dvec2 extent{40.0};      ///< [m] along x and z
    glm::uvec2 cells{200U, 200U}; ///< along x and z, at least 1
};

/// Ground whose height [m] above (x, z) is `height`; two triangles a cell, texture coordinates once
/// over the whole, normals by central differences of the grid (one-sided at its borders).
GroundMesh heightfield(const HeightGrid& grid,
                       const std::function<double(double x, double z)>& height);

} // namespace sward::terrain
