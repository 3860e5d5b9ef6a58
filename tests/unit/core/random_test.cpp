#include "core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace sward {
namespace {

TEST(Random, IsUniformInEveryDimension)
{
    constexpr int cells = 64;
    constexpr int draws = 64'000;
    for (std::uint32_t dimension = 0; dimension < 16; ++dimension) {
        std::array<int, cells> counts{};
        for (std::uint64_t i = 0; i < draws; ++i)
            ++counts[static_cast<std::size_t>(uniform(7, i, dimension) * cells)];
        double chiSquare = 0.0;
        for (const int count : counts)
            chiSquare += (count - 1000.0) * (count - 1000.0) / 1000.0;
        // 63 degrees of freedom: mean 63, standard deviation 11.2; six of them.
        EXPECT_LT(chiSquare, 63.0 + 67.0) << "dimension " << dimension;
        EXPECT_GT(chiSquare, 63.0 - 55.0) << "dimension " << dimension;
    }
}

TEST(Random, NeighbouringIndicesAndDimensionsAreUncorrelated)
{
    constexpr int draws = 100'000;
    double byIndex = 0.0;
    double byDimension = 0.0;
    double byKey = 0.0;
    for (std::uint64_t i = 0; i < draws; ++i) {
        const double x = uniform(1, i, 0) - 0.5;
        byIndex += x * (uniform(1, i + 1, 0) - 0.5);
        byDimension += x * (uniform(1, i, 1) - 0.5);
        byKey += x * (uniform(2, i, 0) - 0.5);
    }
    // The product of two such numbers has standard deviation 1/12; five of the mean's.
    const double bound = 5.0 / 12.0 * std::sqrt(double(draws));
    EXPECT_LT(std::abs(byIndex), bound);
    EXPECT_LT(std::abs(byDimension), bound);
    EXPECT_LT(std::abs(byKey), bound);
}

TEST(Random, StaysTheSameForEver)
{
    // A change of these values changes every baked field; it needs a new file version and a
    // changelog entry.
    EXPECT_EQ(hashBits(0, 0), 0xca23bb4e5daf0ff5ULL);
    EXPECT_EQ(hashBits(42, 123456789), 0xdf2b7e67a025d515ULL);
}

TEST(Random, HashesOfSmallNumbersDoNotCollide)
{
    std::set<std::uint64_t> seen;
    for (std::uint64_t key = 0; key < 300; ++key)
        for (std::uint64_t index = 0; index < 300; ++index)
            seen.insert(hashBits(key, index));
    EXPECT_EQ(seen.size(), 90'000U);
}

} // namespace
} // namespace sward
