#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::terrain {

/// For each position the number of its place: equal positions (−0 equals +0) have equal numbers,
/// counted from 0 in the order of first appearance. `count` receives how many there are.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions, std::uint32_t& count);

} // namespace sward::terrain
