#pragma once

#include "core/bounds.h"
#include "interchange/instances.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::interchange {

/// Step of places in a compact export [m], 2⁻¹¹: half of it, 0.25 mm, is the largest error along an
/// axis. It is the root step of the field's widest patches (32 m / 65535). Groups wider than 8 km
/// have larger steps; see placeExponent().
inline constexpr int compactPlaceExponent = -11;

/// Bits of a component of a quaternion. An instance is turned by at most compactTurn.
inline constexpr int compactRotationBits = 9;
inline constexpr float compactTurn = 0.0105f; ///< [rad] 0.6°

/// Largest error of a scale, relative to the largest scale along this axis of the same species in
/// the group: half a step, with at least 128 steps up to the largest.
inline constexpr float compactScaleError = 1.0f / 256.0f;

/// Steps of a share from 0 to 1 in _TRAITS and _TINT: those of the field (shared::PackedBlade), so
/// nothing is lost.
inline constexpr float stiffnessSteps = 63.0f;
inline constexpr float exposureSteps = 31.0f;
inline constexpr glm::vec3 tintSteps{31.0f, 63.0f, 31.0f};

/// One attribute of compact instances. Every element is a multiple of four bytes.
struct CompactAttribute {
    const char* name;
    const char* type;  ///< VEC3, VEC4
    int componentType; ///< 5126 float, 5121 unsigned byte, 5122 short, 5123 unsigned short
    bool normalized;
    std::size_t stride; ///< of one element [bytes]
    const char* filter; ///< of meshopt: EXPONENTIAL, QUATERNION or NONE
};

/// The attributes in file order: TRANSLATION, ROTATION, SCALE, _TRAITS, _TINT, and _ROOT_ID if
/// `withIds`.
std::span<const CompactAttribute> compactAttributes(bool withIds);

/// The instances of one species, as a range of the group's.
struct SpeciesRange {
    std::uint32_t species = 0;
    std::size_t first = 0;
    std::size_t count = 0;
    Aabb places; ///< of the decoded places [m], exact in single precision
};

/// The instances of a group, compressed by meshoptimizer's attribute codec, version 0.
struct CompactInstances {
    std::size_t count = 0;
    std::vector<SpeciesRange> ranges;            ///< by species, without gaps
    std::vector<std::vector<std::byte>> streams; ///< one per compactAttributes()
};

/// Exponent of two of the step of places that lie within `largest` [m] of their node:
/// compactPlaceExponent, or the least with which they fit into 23 bits.
int placeExponent(float largest);

/// Quantises and compresses instances that are sorted by species. Throws Error{runtime} if the
/// codec fails.
CompactInstances compressInstances(std::span<const Instance> instances, bool withIds);

} // namespace sward::interchange
