#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::terrain {

/// Number of fans of the triangles around a vertex; a fan is connected by edges at the vertex.
/// `around` is sorted; `neighbours` is as in Adjacency.
std::size_t countFans(const std::vector<std::uint32_t>& around, std::uint32_t vertex,
                      const std::vector<glm::uvec3>& triangles,
                      const std::vector<glm::uvec3>& neighbours);

} // namespace sward::terrain
