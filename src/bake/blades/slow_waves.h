#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace sward::bake {

/// Value noise in [-1, 1] that is 0 on the average: the sum of two waves of these lengths
/// [m], 0.75 and 0.5 high, clamped. Standard deviation 0.36. Continuous in `place` [m]; every seed
/// has other waves.
double slowWaves(glm::dvec3 place, double shorter, double longer, std::uint64_t seed);

} // namespace sward::bake
