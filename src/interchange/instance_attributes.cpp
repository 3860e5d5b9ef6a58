#include "interchange/instance_attributes.h"

#include "interchange/gltf.h"

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
};

constexpr std::size_t bytesOfAll()
{
    std::size_t sum = 0;
    for (const InstanceAttribute& attribute : attributes)
        sum += attribute.bytes;
    return sum;
}
static_assert(bytesOfAll() == glbBytesPerBlade);

} // namespace

std::span<const InstanceAttribute> instanceAttributes()
{
    return attributes;
}

std::vector<std::byte> attributeBytes(std::span<const Instance> instances)
{
    std::vector<std::byte> bytes(instances.size() * glbBytesPerBlade);
    std::byte* to = bytes.data();
    for (const InstanceAttribute& attribute : attributes)
        for (const Instance& instance : instances) {
            attribute.store(instance, to);
            to += attribute.bytes;
        }
    return bytes;
}

} // namespace sward::interchange
