#include "apps/sward_view/picture/at_rest.h"
#include "apps/sward_view/picture/refined_picture.h"

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

/// The edge after passes on a device whose tiles take `fixed` + `pixels` times their area [s].
std::uint32_t settledEdge(double fixed, double perPixel)
{
    std::uint32_t edge = 192;
    for (int pass = 0; pass < 10; ++pass)
        edge = nextTileEdge(edge, fixed + perPixel * edge * edge);
    return edge;
}

TEST(NextTileEdge, MakesTilesAsLargeAsAnAnswerToInputAllows)
{
    for (const double perPixel : {0.4e-6, 0.8e-6, 1.2e-6}) {
        const std::uint32_t edge = settledEdge(0.01, perPixel);
        const double seconds = 0.01 + perPixel * edge * edge;
        EXPECT_LT(seconds, 0.13) << perPixel;
        EXPECT_GT(seconds, 0.04) << perPixel;
        EXPECT_EQ(edge, nextTileEdge(edge, seconds)) << "stands still";
    }
}

TEST(NextTileEdge, IsBoundedOnAnyDevice)
{
    EXPECT_EQ(settledEdge(10.0, 1.0), 128u);
    EXPECT_EQ(settledEdge(0.0, 0.0), 512u);
}

TEST(RefinedSettings, HaveTheNarrowestBladesOfSixteenSamples)
{
    // In distances of samples: the mean of sixteen pictures has them closer.
    const render::FrameSettings settings;
    EXPECT_FLOAT_EQ(refinedSettings(settings, 1).minPixels, 0.25f * settings.minPixels);
    EXPECT_FLOAT_EQ(refinedSettings(settings, 4).minPixels, 0.5f * settings.minPixels);
}

} // namespace
} // namespace sward::view
