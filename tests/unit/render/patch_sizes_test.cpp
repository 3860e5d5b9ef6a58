#include "render/field/patch_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace sward::render {
namespace {

std::vector<shared::Patch> patchesOf(const std::vector<std::uint32_t>& sizes)
{
    std::vector<shared::Patch> patches(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i)
        patches[i].bladeCount = sizes[i];
    return patches;
}

TEST(PatchSizes, NoChoiceOfPatchesHasMoreBladesThanTheLargest)
{
    std::mt19937 dice(31);
    const auto below = [&dice](std::uint32_t end) { return std::uint32_t(dice()) % end; };
    for (int run = 0; run < 200; ++run) {
        std::vector<std::uint32_t> sizes(1 + below(40));
        for (std::uint32_t& size : sizes)
            size = below(2) == 0 ? below(5) : below(shared::maxPatchBlades + 1);
        const std::vector<shared::Patch> patches = patchesOf(sizes);
        const PatchSizes known(patches);
        std::sort(sizes.begin(), sizes.end(), std::greater<>());
        std::uint64_t blades = 0;
        for (std::size_t n = 0; n <= sizes.size(); ++n) {
            ASSERT_EQ(known.maxBladesOf(n), blades);
            // This number fits for any choice of patches, and not with one blade less.
            if (n > 0 && sizes[n - 1] > 0) {
                ASSERT_GE(known.patchesWithin(blades), n);
                ASSERT_LT(known.patchesWithin(blades - 1), n);
            }
            if (n < sizes.size())
                blades += sizes[n];
        }
        ASSERT_EQ(known.maxBladesOf(1000), blades);
        const auto nonEmptyPatches =
            std::count_if(sizes.begin(), sizes.end(), [](auto s) { return s > 0; });
        ASSERT_EQ(known.patchesWithin(blades), std::uint32_t(nonEmptyPatches));
    }
}

TEST(PatchSizes, OfAFieldWithoutBladesAreNone)
{
    const PatchSizes none(patchesOf({0, 0}));
    EXPECT_EQ(none.maxBladesOf(2), 0u);
    EXPECT_EQ(none.patchesWithin(1000), 0u);
}

} // namespace
} // namespace sward::render
