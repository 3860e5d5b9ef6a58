#include "interchange/compact/morton_order.h"

#include "core/bounds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sward::interchange {
namespace {

// Cells along one axis. Three times 20 bits leave room for the species in a key of 64 bits.
constexpr std::uint32_t mortonBits = 20;

// Puts two zeros between neighbouring bits.
std::uint64_t spread(std::uint32_t cell)
{
    std::uint64_t bits = 0;
    for (std::uint32_t i = 0; i < mortonBits; ++i)
        bits |= std::uint64_t(cell >> i & 1U) << (3U * i);
    return bits;
}

std::uint64_t mortonKey(const Instance& instance, const glm::vec3& low, float step)
{
    const glm::vec3 cell = glm::clamp((instance.place - low) / step, 0.0f,
                                      float((std::uint32_t(1) << mortonBits) - 1));
    return std::uint64_t(instance.blade.species) << (3U * mortonBits) |
           spread(static_cast<std::uint32_t>(cell.x)) |
           spread(static_cast<std::uint32_t>(cell.z)) << 1U |
           spread(static_cast<std::uint32_t>(cell.y)) << 2U;
}

} // namespace

void sortForCompression(std::vector<Instance>& instances, float step)
{
    Aabb places;
    for (const Instance& instance : instances)
        places.add(instance.place);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    keys.reserve(instances.size());
    for (const Instance& instance : instances)
        keys.emplace_back(mortonKey(instance, places.low, step),
                          static_cast<std::uint32_t>(keys.size()));
    std::sort(keys.begin(), keys.end());
    std::vector<Instance> sorted;
    sorted.reserve(instances.size());
    for (const auto& [key, index] : keys)
        sorted.push_back(instances[index]);
    instances = std::move(sorted);
}

} // namespace sward::interchange
