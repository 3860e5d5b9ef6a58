#include "core/random.h"
#include "render/field/free_ranges.h"

#include <gtest/gtest.h>

#include <vector>

namespace sward::render {
namespace {

TEST(FreeRanges, GiveNoPlaceTwice)
{
    constexpr std::uint32_t size = 1000;
    FreeRanges free;
    free.give({0, size});
    std::vector<bool> isUsed(size, false);
    std::vector<PlaceRange> taken;
    for (std::uint64_t step = 0; step < 5000; ++step) {
        const auto dice = [&](std::uint32_t bound, std::uint32_t dimension) {
            return static_cast<std::uint32_t>(uniform(3, step, dimension) * bound);
        };
        if (!taken.empty() && dice(2, 0) == 0) {
            const std::uint32_t which = dice(static_cast<std::uint32_t>(taken.size()), 1);
            for (std::uint32_t i = taken[which].first; i < taken[which].end(); ++i)
                isUsed[i] = false;
            free.give(taken[which]);
            taken[which] = taken.back();
            taken.pop_back();
        } else if (const auto range = free.take(1 + dice(30, 2))) {
            ASSERT_LE(range->end(), size);
            for (std::uint32_t i = range->first; i < range->end(); ++i) {
                ASSERT_FALSE(isUsed[i]);
                isUsed[i] = true;
            }
            taken.push_back(*range);
        }
        std::uint32_t end = size;
        while (end > 0 && !isUsed[end - 1])
            --end;
        ASSERT_EQ(free.usedEnd(size), end);
    }
    for (const PlaceRange& range : taken)
        free.give(range);
    EXPECT_EQ(free.take(size), (PlaceRange{0, size})) << "neighbours are merged";
}

TEST(FreeRanges, TakeTheSmallestThatSuffices)
{
    FreeRanges free;
    free.give({0, 10});
    free.give({20, 4});
    free.give({30, 6});
    EXPECT_EQ(free.take(5), (PlaceRange{30, 5}));
    EXPECT_EQ(free.take(4), (PlaceRange{20, 4}));
    EXPECT_FALSE(free.take(11).has_value());
}

} // namespace
} // namespace sward::render
