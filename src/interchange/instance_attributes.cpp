#include "interchange/instance_attributes.h"

#include "core/math/srgb.h"
#include "interchange/gltf.h"

#include <glm/common.hpp>

#include <array>
#include <cmath>
#include <cstring>

namespace sward::interchange {
namespace {

constexpr int unsignedByte = 5121;
constexpr int unsignedShort = 5123;
constexpr int floating = 5126;

template <typename T, std::size_t Count>
void put(std::byte* to, const std::array<T, Count>& values)
{
    std::memcpy(to, values.data(), sizeof values);
}

std::uint8_t unsignedByteOf(float share)
{
    return static_cast<std::uint8_t>(std::lround(255.0f * share));
}

void storePlace(const Instance& i, std::byte* to)
{
    put<float, 3>(to, {i.place.x, i.place.y, i.place.z});
}

void storeRotation(const Instance& i, std::byte* to)
{
    put<float, 4>(to, {i.rotation.x, i.rotation.y, i.rotation.z, i.rotation.w});
}

void storeScale(const Instance& i, std::byte* to)
{
    put<float, 3>(to, {i.scale.x, i.scale.y, i.scale.z});
}

void storeStiffness(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.blade.stiffness});
}

void storeHeight(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.blade.height});
}

void storeWidth(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.blade.width});
}

void storeExposure(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.blade.exposure});
}

void storeSpecies(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {static_cast<float>(i.blade.species)});
}

void storeClump(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {static_cast<float>(i.blade.clump)});
}

// Stores 53 bits as four 16-bit numbers, lowest first; every reader represents them exactly.
void storeId(const Instance& i, std::byte* to)
{
    put<std::uint16_t, 4>(
        to, {static_cast<std::uint16_t>(i.id), static_cast<std::uint16_t>(i.id >> 16),
             static_cast<std::uint16_t>(i.id >> 32), static_cast<std::uint16_t>(i.id >> 48)});
}

void storeTint(const Instance& i, std::byte* to)
{
    put<std::uint8_t, 4>(to, {unsignedByteOf(i.blade.tint.x), unsignedByteOf(i.blade.tint.y),
                              unsignedByteOf(i.blade.tint.z), 255});
}

void storeRank(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.rank});
}

// A linear colour, coded as in images: 8 bits then suffice for dark ones.
void storeColor(const glm::vec3& color, std::byte* to)
{
    const auto byte = [](float value) {
        return unsignedByteOf(encodedOf(glm::clamp(value, 0.0f, 1.0f)));
    };
    put<std::uint8_t, 4>(to, {byte(color.x), byte(color.y), byte(color.z), 255});
}

void storeRootColor(const Instance& i, std::byte* to)
{
    storeColor(i.look.root, to);
}

void storeTipColor(const Instance& i, std::byte* to)
{
    storeColor(i.look.tip, to);
}

void storeLeafArea(const Instance& i, std::byte* to)
{
    put<float, 1>(to, {i.look.leafArea});
}

constexpr InstanceAttribute attributes[] = {
    {"TRANSLATION", "VEC3", floating, false, 12, storePlace},
    {"ROTATION", "VEC4", floating, false, 16, storeRotation},
    {"SCALE", "VEC3", floating, false, 12, storeScale},
    {"_STIFFNESS", "SCALAR", floating, false, 4, storeStiffness},
    {"_HEIGHT", "SCALAR", floating, false, 4, storeHeight},
    {"_WIDTH", "SCALAR", floating, false, 4, storeWidth},
    {"_EXPOSURE", "SCALAR", floating, false, 4, storeExposure},
    {"_SPECIES", "SCALAR", floating, false, 4, storeSpecies},
    {"_CLUMP", "SCALAR", floating, false, 4, storeClump},
    {"_ROOT_ID", "VEC4", unsignedShort, false, 8, storeId},
    {"_TINT", "VEC4", unsignedByte, true, 4, storeTint},
    {"_RANK", "SCALAR", floating, false, 4, storeRank},
    {"_ROOT_COLOR", "VEC4", unsignedByte, true, 4, storeRootColor},
    {"_TIP_COLOR", "VEC4", unsignedByte, true, 4, storeTipColor},
    {"_LEAF_AREA", "SCALAR", floating, false, 4, storeLeafArea},
};

// Attributes of every file; the others are for engines.
constexpr std::size_t everyFile = 11;

constexpr std::size_t bytesOf(std::span<const InstanceAttribute> list)
{
    std::size_t sum = 0;
    for (const InstanceAttribute& attribute : list)
        sum += attribute.bytes;
    return sum;
}
static_assert(bytesOf(std::span(attributes).first(everyFile)) == glbBytesPerBlade);
static_assert(bytesOf(attributes) == glbBytesPerEngineBlade);

} // namespace

std::span<const InstanceAttribute> instanceAttributes(bool forEngines)
{
    return forEngines ? std::span(attributes) : std::span(attributes).first(everyFile);
}

std::vector<std::byte> attributeBytes(std::span<const Instance> instances, bool forEngines)
{
    const std::span<const InstanceAttribute> list = instanceAttributes(forEngines);
    std::vector<std::byte> bytes(instances.size() * bytesOf(list));
    std::byte* to = bytes.data();
    for (const InstanceAttribute& attribute : list)
        for (const Instance& instance : instances) {
            attribute.store(instance, to);
            to += attribute.bytes;
        }
    return bytes;
}

} // namespace sward::interchange
