#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::terrain {

/// Corners of a polygon that make a triangle, numbered from 0.
using PolygonTriangle = std::array<std::uint32_t, 3>;

/// Polygons with more corners become fans; ear clipping takes the square of their number.
inline constexpr std::size_t earLimit = 4096;

/// Divides a polygon into triangles. A fan around corner 0, if no triangle of it is turned over;
/// else ears, clipped in the plane of the polygon's Newell normal, so that nothing lies outside. A
/// hole may be reached by an edge that is passed twice. `crosses` is set if the edges cross, so
/// that the polygon has no inside, and for a polygon above earLimit that is no fan.
std::vector<PolygonTriangle> triangulate(std::span<const glm::dvec3> corners, bool& crosses);

} // namespace sward::terrain
