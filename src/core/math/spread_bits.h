#pragma once

#include <cstdint>

namespace sward {

/// Inserts two zeros after each of the lower 21 bits of `x`. Three such numbers, shifted by 0, 1
/// and 2, form a Morton code.
constexpr std::uint64_t spreadBits(std::uint32_t x)
{
    std::uint64_t bits = x & 0x1fffffU;
    bits = (bits | bits << 32) & 0x001f00000000ffffULL;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    bits = (bits | bits << 2) & 0x1249249249249249ULL;
    return bits;
}

/// Morton code of a cell with coordinates below 2²¹.
constexpr std::uint64_t mortonCode(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
    return spreadBits(x) | spreadBits(y) << 1 | spreadBits(z) << 2;
}

} // namespace sward
