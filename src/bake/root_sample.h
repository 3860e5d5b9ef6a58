#pragma once

#include "field/field.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::bake {

/// A point of the surface where a blade may stand.
struct RootSample {
    field::BladeKey key;
    glm::vec2 barycentric{0.0f}; ///< weights of the triangle's second and third corner
    glm::vec3 position{0.0f};    ///< [m] relative to the ground's origin
    glm::vec3 normal{0.0f};      ///< unit, of the side it grows on
    float exposure = 1.0f;       ///< [0, 1] share of the sky that its rays reached
};

/// Bit of a candidate's number that says: on the back of the triangle.
inline constexpr std::uint32_t backSide = 0x80000000U;

/// What a blade's random numbers are for. Each is uniform(seed, keyBits(key), dimension).
enum class Dimension : std::uint32_t {
    count,
    u,
    v,
    mask,
    slope,
    altitude,
    priority,
    rayTurn,
    raySlope,
    species,
    height,
    width,
    stiffness,
    facing,
    hash,
    clump
};

constexpr std::uint64_t keyBits(field::BladeKey key)
{
    return std::uint64_t(key.triangle) << 32 | key.candidate;
}

} // namespace sward::bake
