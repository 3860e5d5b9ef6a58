#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// Chooses `count` of the points so that every prefix of the result is itself evenly spread: each
/// next point is the one farthest from those before it (Gonzalez 1985), beginning with points[0].
/// Returns indices into `points`; of equals the lowest. Cost: count × points.
std::vector<std::uint32_t> progressiveOrder(std::span<const glm::vec3> points, std::size_t count);

} // namespace sward::bake
