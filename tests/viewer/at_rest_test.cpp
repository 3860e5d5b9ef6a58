#include "apps/sward_view/at_rest.h"

#include <gtest/gtest.h>

namespace sward::view {
namespace {

using Draws = AtRest::Draws;

constexpr double still = AtRest::delay + 0.001; ///< [s]

/// A state that has begun to refine at `still`.
AtRest resting()
{
    AtRest rest;
    rest.next(0.0, true);
    rest.next(still, false);
    return rest;
}

TEST(AtRest, BeginsWithMovingPictures)
{
    AtRest rest;
    EXPECT_EQ(rest.next(100.0, false), Draws::moving);
    EXPECT_FALSE(rest.isResting());
}

TEST(AtRest, RefinesWithinASecondOfTheLastChange)
{
    AtRest rest;
    for (double now = 0.0; now < 3.0; now += 0.1)
        EXPECT_EQ(rest.next(now, true), Draws::moving);
    EXPECT_EQ(rest.next(3.0, true), Draws::moving);
    EXPECT_EQ(rest.next(3.0 + 0.9 * AtRest::delay, false), Draws::moving);
    EXPECT_LT(AtRest::delay, 1.0);
    EXPECT_EQ(rest.next(3.0 + still, false), Draws::refined);
    EXPECT_TRUE(rest.isResting());
}

TEST(AtRest, AbandonsTheFinePictureAtOnceWhenSomethingChanges)
{
    AtRest rest = resting();
    rest.finishPass();
    EXPECT_EQ(rest.next(still + 0.01, true), Draws::moving);
    EXPECT_FALSE(rest.isResting());
    EXPECT_EQ(rest.passesDone(), 0u);
    // And waits for the whole delay again.
    EXPECT_EQ(rest.next(still + 0.02, false), Draws::moving);
    EXPECT_EQ(rest.next(2.0 * still + 0.02, false), Draws::refined);
}

TEST(AtRest, DrawsNothingAfterTheLastPassUntilSomethingChanges)
{
    AtRest rest = resting();
    std::uint32_t drawn = 0;
    for (double now = still; rest.next(now, false) == Draws::refined; now += 0.1, ++drawn) {
        ASSERT_LT(drawn, 1000u);
        rest.finishPass();
    }
    EXPECT_EQ(drawn, AtRest::passes);
    for (double now = 100.0; now < 200.0; now += 1.0)
        EXPECT_EQ(rest.next(now, false), Draws::nothing);
    EXPECT_TRUE(rest.isResting());
    EXPECT_EQ(rest.next(200.0, true), Draws::moving);
    EXPECT_EQ(rest.next(200.0 + still, false), Draws::refined);
}

TEST(AtRest, KeepsRefiningWhileAPassTakesSeveralCalls)
{
    AtRest rest = resting();
    for (int tile = 0; tile < 100; ++tile)
        EXPECT_EQ(rest.next(still + 0.05 * tile, false), Draws::refined);
    EXPECT_EQ(rest.passesDone(), 0u);
}

} // namespace
} // namespace sward::view
