#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::terrain {

/// Numbers positions: equal positions (−0 equals +0) get equal numbers, from 0 in order of first
/// appearance. `count` receives the number of distinct positions.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions, std::uint32_t& count);

} // namespace sward::terrain
