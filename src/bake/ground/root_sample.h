#pragma once

#include "core/uninitialized.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::bake {

/// A surface point where a blade may stand. Uninitialised by default, because there are millions.
struct RootSample {
    std::uint32_t triangle;  ///< index in this ground, which may be a part of the whole
    std::uint32_t candidate; ///< candidate number on that triangle, and `backSide`
    glm::vec2 barycentric;   ///< weights of the triangle's second and third corner
    glm::vec3 position;      ///< [m] relative to the ground's origin
    glm::vec3 normal;        ///< unit, of the triangle side it grows on
};

using Roots = UninitializedVector<RootSample>;

/// Bit of a candidate's number: set on the back of the triangle.
inline constexpr std::uint32_t backSide = 0x80000000U;

/// Purpose of a blade's random number: uniform(seed, keyBits(key), dimension).
enum class Dimension : std::uint32_t {
    count,
    place,
    chance,
    priority,
    rayTurn,
    raySlope,
    species,
    height,
    width,
    stiffness,
    facing,
    hash,
    clump,
    sky,
    dryness,
    litter,
    paint
};

constexpr std::uint64_t keyBits(field::BladeKey key)
{
    return std::uint64_t(key.triangle) << 32 | key.candidate;
}

/// The root's key. It stores the triangle's number in the whole ground.
inline field::BladeKey keyOf(const terrain::GroundMesh& ground, const RootSample& root)
{
    return {ground.source(root.triangle), root.candidate};
}

} // namespace sward::bake
