#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace sward::terrain {

// Noise from integer hashes and + − × ÷ √ only, so that it is equal on every CPU.

/// Gradient noise (Perlin 2002, with a random unit gradient at each lattice point): continuous with
/// its first two derivatives, 0 at every lattice point, inside (−1, 1). |coordinates| ≤ 1e9.
double gradientNoise(std::uint64_t seed, const glm::dvec3& point);

/// Parameters of an octave sum.
struct Octaves {
    int count = 5;           ///< [1, 12]
    double lacunarity = 2.0; ///< each octave is this much finer than the last
    double gain = 0.5;       ///< amplitude factor per octave
};

/// Fractal sum of octaves, scaled so that |value| < 1.
double fractalNoise(std::uint64_t seed, const glm::dvec3& point, const Octaves& octaves);

/// The same with each octave folded to 1 − |noise|, which makes crests (Musgrave 1998); in (0, 1].
double ridgedNoise(std::uint64_t seed, const glm::dvec3& point, const Octaves& octaves);

} // namespace sward::terrain
