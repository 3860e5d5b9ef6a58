#include "terrain/topology/weld.h"

#include "core/random.h"

#include <bit>

namespace sward::terrain {
namespace {

// Adding 0 makes +0 of −0.
std::uint64_t hashPosition(const glm::vec3& p)
{
    const auto x = std::bit_cast<std::uint32_t>(p.x + 0.0f);
    const auto y = std::bit_cast<std::uint32_t>(p.y + 0.0f);
    const auto z = std::bit_cast<std::uint32_t>(p.z + 0.0f);
    return hashBits((std::uint64_t(x) << 32) | y, z);
}

} // namespace

std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions, std::uint32_t& count)
{
    constexpr std::uint32_t empty = 0xffffffffU;
    // A table of first appearances with open addressing, at most half full.
    const std::size_t slots = std::bit_ceil(2 * positions.size() + 1);
    std::vector<std::uint32_t> table(slots, empty);

    std::vector<std::uint32_t> numbers(positions.size());
    count = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        std::size_t slot = hashPosition(positions[i]) & (slots - 1);
        while (table[slot] != empty && positions[table[slot]] != positions[i])
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == empty) {
            table[slot] = static_cast<std::uint32_t>(i);
            numbers[i] = count++;
        } else {
            numbers[i] = numbers[table[slot]];
        }
    }
    return numbers;
}

} // namespace sward::terrain
