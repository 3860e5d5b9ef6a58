#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace sward::bake {

/// Places in space, one array for each axis.
struct PlaceBlock {
    static constexpr std::size_t size = 64;
    alignas(32) std::array<double, size> x;
    alignas(32) std::array<double, size> y;
    alignas(32) std::array<double, size> z;

    void set(std::size_t i, glm::dvec3 place)
    {
        x[i] = place.x;
        y[i] = place.y;
        z[i] = place.z;
    }
};

/// One number for each place of a block.
using BlockOfFloats = std::array<float, PlaceBlock::size>;

/// Value noise in [-1, 1] that is 0 on the average: the sum of two waves of these lengths [m], 0.75
/// and 0.5 high, clamped. Standard deviation 0.36. Continuous in `place` [m], to 1e-6 of a wave's
/// height; every seed has other waves.
double slowWaves(glm::dvec3 place, double shorter, double longer, std::uint64_t seed);

/// The same for a block of places; each result is that of its place alone. All places must be
/// finite. `wide`: with SWARD_WIDE, which gives the same bits.
void slowWaves(const PlaceBlock& places, double shorter, double longer, std::uint64_t seed,
               BlockOfFloats& waves, bool wide);
void slowWaves(const PlaceBlock& places, double shorter, double longer, std::uint64_t seed,
               BlockOfFloats& waves);

} // namespace sward::bake
