#include "core/random.h"
#include "gpu/recording/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sward::gpu {
namespace {

TEST(Statistics, OfNothingAreZero)
{
    const Statistics statistics = statisticsOf({});
    EXPECT_EQ(statistics.count, 0U);
    EXPECT_EQ(statistics.min, 0.0);
    EXPECT_EQ(statistics.median, 0.0);
    EXPECT_EQ(statistics.p99, 0.0);
}

TEST(Statistics, OfOneValueAreThatValue)
{
    const double value = 7.25;
    const Statistics statistics = statisticsOf({&value, 1});
    EXPECT_EQ(statistics.min, value);
    EXPECT_EQ(statistics.median, value);
    EXPECT_EQ(statistics.p99, value);
}

TEST(Statistics, FollowTheirDefinitionsForAnyNumberOfValues)
{
    constexpr std::uint64_t seed = 31;
    for (std::size_t count = 1; count <= 401; count += 8) {
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i)
            values[i] = uniform(seed, count, static_cast<std::uint32_t>(i));
        const Statistics statistics = statisticsOf(values);

        const auto notAbove = [&](double bound) {
            return static_cast<std::size_t>(
                std::ranges::count_if(values, [&](double value) { return value <= bound; }));
        };
        EXPECT_EQ(statistics.count, count);
        EXPECT_EQ(statistics.min, *std::ranges::min_element(values));
        EXPECT_GE(2 * notAbove(statistics.median), count) << "seed " << seed;
        EXPECT_LE(2 * (notAbove(statistics.median) - 1), count) << "seed " << seed;
        // 99 % are not above it, and one value less would be too few.
        EXPECT_GE(100 * notAbove(statistics.p99), 99 * count) << "seed " << seed;
        EXPECT_LT(100 * (notAbove(statistics.p99) - 1), 99 * count) << "seed " << seed;
    }
}

TEST(Statistics, TakeTheMiddleBetweenTheMiddleTwo)
{
    const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
    EXPECT_EQ(statisticsOf(values).median, 2.5);
}

} // namespace
} // namespace sward::gpu
