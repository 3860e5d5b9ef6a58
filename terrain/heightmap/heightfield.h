#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// A regular grid of heights in the x-z plane.
struct HeightGrid {
    glm::dvec2 extent{40.0};      ///< [m] along x and z
    glm::uvec2 cells{200U, 200U}; ///< along x and z, at least 1
    glm::dvec2 middle{0.0};       ///< [m] x and z of the grid's middle in the world

    std::size_t points() const { return (std::size_t(cells.x) + 1) * (std::size_t(cells.y) + 1); }
};

/// Most points of a grid: 4097 x 4097 fit. Each point takes about 90 bytes of ground, and four
/// times that with rays.
inline constexpr std::size_t heightPointLimit = 17'000'000;

/// A part of a grid: the points whose heights are given, and the cells that become ground.
struct HeightPart {
    glm::uvec2 first{0U};     ///< column and row of the grid where the heights begin
    glm::uvec2 points{0U};    ///< heights along x and z
    std::uint32_t stride = 1; ///< takes every stride-th point of the grid, and its last ones
    glm::uvec2 firstCell{0U}; ///< of the ground, among the cells between these heights
    glm::uvec2 cells{0U};     ///< of the ground; heights around them give the normals at its edge

    std::optional<glm::dvec3> origin{}; ///< of the ground; unset: of its own bounds

    /// Number in the whole ground of the first triangle of each row of cells. Empty: from 0.
    std::span<const std::uint32_t> firstTriangle{};
};

/// Ground with height [m] `height` above (x, z). Two triangles per cell, texture coordinates once
/// over the whole, normals by central differences of the grid (one-sided at borders). `height` is
/// called from several threads.
GroundMesh heightfield(const HeightGrid& grid,
                       const std::function<double(double x, double z)>& height);

/// The same for heights [m] at the grid's points, along x first, from the corner at −x and −z. NaN
/// heights and nonzero cells of `holes` give no ground (`holes`: one entry per cell in the same
/// order, or empty). Throws Error{input} naming `place` if no triangle is left.
GroundMesh heightfield(const HeightGrid& grid, const std::vector<double>& heights,
                       const std::vector<std::uint8_t>& holes, const std::string& place);

/// The same for a part of a grid. Its triangles are those of the whole ground, bit by bit, if the
/// origin is, and if heights around its cells are given where the grid has them. Has no triangles
/// where all are holes.
GroundMesh heightfield(const HeightGrid& grid, const HeightPart& part,
                       const std::vector<double>& heights, const std::string& place);

/// Place [m] along an axis of point `i` of a grid, from its middle.
inline double heightLineAt(std::size_t i, double cells, double extent)
{
    return extent * (static_cast<double>(i) / cells - 0.5);
}

} // namespace sward::terrain
