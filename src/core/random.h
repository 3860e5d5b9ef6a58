#pragma once

#include <cstdint>

namespace sward {

// Stateless random numbers: each is a function of its key and indices. Results do not depend on the
// order or number of threads.

/// Mixes 64 bits so that every input bit reaches every output bit (the finaliser of SplitMix64,
/// Steele, Lea & Flood 2014).
constexpr std::uint64_t mixBits(std::uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ULL;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebULL;
    x ^= x >> 31;
    return x;
}

/// 64 random bits for (key, index).
constexpr std::uint64_t hashBits(std::uint64_t key, std::uint64_t index)
{
    return mixBits(mixBits(key + 0x9e3779b97f4a7c15ULL) ^
                   (index * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL));
}

/// Uniform in [0, 1), a multiple of 2⁻⁵³, for (key, index, dimension).
constexpr double uniform(std::uint64_t key, std::uint64_t index, std::uint32_t dimension)
{
    return static_cast<double>(hashBits(hashBits(key, index), dimension) >> 11) * 0x1.0p-53;
}

} // namespace sward
