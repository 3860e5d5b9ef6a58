#include "interchange/compact/compact_instances.h"

#include "core/error.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace sward::interchange {
namespace {

constexpr int byteComponent = 5121;
constexpr int shortComponent = 5122;
constexpr int unsignedShortComponent = 5123;
constexpr int floatComponent = 5126;

constexpr CompactAttribute allAttributes[] = {
    {"TRANSLATION", "VEC3", floatComponent, false, 12, "EXPONENTIAL"},
    {"ROTATION", "VEC4", shortComponent, true, 8, "QUATERNION"},
    {"SCALE", "VEC3", floatComponent, false, 12, "EXPONENTIAL"},
    {"_TRAITS", "VEC4", byteComponent, false, 4, "NONE"},
    {"_TINT", "VEC4", byteComponent, false, 4, "NONE"},
    {"_ROOT_ID", "VEC4", unsignedShortComponent, false, 8, "NONE"},
};

// Largest mantissa of the exponential filter that keeps a sign, and of a scale in one byte.
constexpr float largestMantissa = 8388607.0f; // 2²³ − 1
constexpr float largestScale = 255.0f;

// Least exponent with which numbers up to `largest` have mantissas up to `mantissa`.
int exponentFor(float largest, float mantissa, int least)
{
    int exponent = least;
    while (std::ldexp(mantissa, exponent) < largest)
        ++exponent;
    return exponent;
}

// A number of the exponential filter: exponent in the upper 8 bits, mantissa in the lower 24.
std::uint32_t exponential(std::int32_t mantissa, int exponent)
{
    return (static_cast<std::uint32_t>(exponent) << 24U) |
           (static_cast<std::uint32_t>(mantissa) & 0xffffffU);
}

std::int32_t steps(float value, int exponent)
{
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, -exponent)));
}

// The step of a share that the field stores in `most` steps.
std::uint8_t stepOf(float share, float most)
{
    return static_cast<std::uint8_t>(std::lround(most * glm::clamp(share, 0.0f, 1.0f)));
}

template <typename T>
std::vector<std::byte> compressed(const std::vector<T>& elements)
{
    // The version that EXT_meshopt_compression knows; later libraries write a newer one.
    meshopt_encodeVertexVersion(0);
    std::vector<std::byte> bytes(meshopt_encodeVertexBufferBound(elements.size(), sizeof(T)));
    const std::size_t size =
        meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                   elements.data(), elements.size(), sizeof(T));
    if (size == 0)
        fail(ErrorKind::runtime, "{} instances cannot be compressed", elements.size());
    bytes.resize(size);
    return bytes;
}

using Triple = std::array<std::uint32_t, 3>;

// The places of all instances; sets the boxes of `ranges`.
std::vector<Triple> placesOf(std::span<const Instance> instances, std::vector<SpeciesRange>& ranges)
{
    float largest = 0.0f;
    for (const Instance& instance : instances)
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(largest, std::fabs(instance.place[axis]));
    const int exponent = placeExponent(largest);
    std::vector<Triple> places;
    places.reserve(instances.size());
    for (SpeciesRange& range : ranges)
        for (const Instance& instance : instances.subspan(range.first, range.count)) {
            Triple triple;
            glm::vec3 decoded;
            for (int axis = 0; axis < 3; ++axis) {
                const std::int32_t mantissa = steps(instance.place[axis], exponent);
                triple[static_cast<std::size_t>(axis)] = exponential(mantissa, exponent);
                decoded[axis] = std::ldexp(float(mantissa), exponent);
            }
            places.push_back(triple);
            range.places.add(decoded);
        }
    return places;
}

// The scales of all instances. Steps depend on the species, whose sizes differ.
std::vector<Triple> scalesOf(std::span<const Instance> instances,
                             const std::vector<SpeciesRange>& ranges)
{
    std::vector<Triple> scales;
    scales.reserve(instances.size());
    for (const SpeciesRange& range : ranges) {
        const auto own = instances.subspan(range.first, range.count);
        glm::vec3 largest(0.0f);
        for (const Instance& instance : own)
            largest = glm::max(largest, instance.scale);
        std::array<int, 3> exponents;
        for (int axis = 0; axis < 3; ++axis)
            exponents[static_cast<std::size_t>(axis)] =
                exponentFor(largest[axis], largestScale, -40);
        for (const Instance& instance : own) {
            Triple triple;
            for (int axis = 0; axis < 3; ++axis) {
                // A scale is never 0.
                const int exponent = exponents[static_cast<std::size_t>(axis)];
                const std::int32_t mantissa = std::max(steps(instance.scale[axis], exponent), 1);
                triple[static_cast<std::size_t>(axis)] = exponential(mantissa, exponent);
            }
            scales.push_back(triple);
        }
    }
    return scales;
}

std::vector<std::array<std::int16_t, 4>> rotationsOf(std::span<const Instance> instances)
{
    std::vector<std::array<float, 4>> quaternions;
    quaternions.reserve(instances.size());
    for (const Instance& i : instances)
        quaternions.push_back({i.rotation.x, i.rotation.y, i.rotation.z, i.rotation.w});
    std::vector<std::array<std::int16_t, 4>> packed(instances.size());
    meshopt_encodeFilterQuat(packed.data(), packed.size(), sizeof packed[0], compactRotationBits,
                             quaternions.data()->data());
    return packed;
}

// The rest of what a blade knows.
template <typename T, typename Of>
std::vector<std::array<T, 4>> elementsOf(std::span<const Instance> instances, Of of)
{
    std::vector<std::array<T, 4>> elements;
    elements.reserve(instances.size());
    for (const Instance& instance : instances)
        elements.push_back(of(instance));
    return elements;
}

// Small integers, whose differences have fewer bits than those of the same as bytes of 0 to 255.
std::array<std::uint8_t, 4> traitsOf(const Instance& i)
{
    return {stepOf(i.blade.stiffness, stiffnessSteps), stepOf(i.blade.exposure, exposureSteps),
            static_cast<std::uint8_t>(i.blade.clump), 0};
}

std::array<std::uint8_t, 4> tintOf(const Instance& i)
{
    return {stepOf(i.blade.tint.x, tintSteps.x), stepOf(i.blade.tint.y, tintSteps.y),
            stepOf(i.blade.tint.z, tintSteps.z), 0};
}

std::array<std::uint16_t, 4> idOf(const Instance& i)
{
    return {static_cast<std::uint16_t>(i.id), static_cast<std::uint16_t>(i.id >> 16),
            static_cast<std::uint16_t>(i.id >> 32), static_cast<std::uint16_t>(i.id >> 48)};
}

std::vector<SpeciesRange> rangesOf(std::span<const Instance> instances)
{
    std::vector<SpeciesRange> ranges;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint32_t species = instances[i].blade.species;
        if (ranges.empty() || ranges.back().species != species)
            ranges.push_back({.species = species, .first = i, .count = 0, .places = {}});
        ++ranges.back().count;
    }
    return ranges;
}

} // namespace

std::span<const CompactAttribute> compactAttributes(bool withIds)
{
    return std::span(allAttributes).first(std::size(allAttributes) - (withIds ? 0 : 1));
}

int placeExponent(float largest)
{
    return exponentFor(largest, largestMantissa, compactPlaceExponent);
}

CompactInstances compressInstances(std::span<const Instance> instances, bool withIds)
{
    CompactInstances result;
    result.count = instances.size();
    result.ranges = rangesOf(instances);
    result.streams.push_back(compressed(placesOf(instances, result.ranges)));
    result.streams.push_back(compressed(rotationsOf(instances)));
    result.streams.push_back(compressed(scalesOf(instances, result.ranges)));
    result.streams.push_back(compressed(elementsOf<std::uint8_t>(instances, traitsOf)));
    result.streams.push_back(compressed(elementsOf<std::uint8_t>(instances, tintOf)));
    if (withIds)
        result.streams.push_back(compressed(elementsOf<std::uint16_t>(instances, idOf)));
    return result;
}

} // namespace sward::interchange
