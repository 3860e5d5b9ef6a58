#include "apps/sward_view/picture/internal_resolution.h"

#include <gtest/gtest.h>

#include <set>

namespace sward::view {
namespace {

constexpr double wanted = 0.1; ///< [s]

/// The scale after `frames` frames on a device with time `fixed` plus `pixels` for all pixels.
double settled(InternalResolution& resolution, double fixed, double pixels, int frames = 200)
{
    for (int i = 0; i < frames; ++i)
        resolution.add(fixed + pixels * resolution.scale() * resolution.scale());
    return resolution.scale();
}

TEST(InternalResolution, DrawsAllPixelsWhereTheyCostLittle)
{
    InternalResolution resolution(wanted, 1.0);
    EXPECT_EQ(settled(resolution, 0.001, 0.015), 1.0);
}

TEST(InternalResolution, MakesFramesQuickEnoughWithAsManyPixelsAsItCan)
{
    InternalResolution resolution(wanted, 1.0);
    const double scale = settled(resolution, 0.02, 1.0);
    EXPECT_LE(0.02 + scale * scale, 1.15 * wanted);
    EXPECT_GE(0.02 + scale * scale, 0.4 * wanted);
}

TEST(InternalResolution, StandsStillOnceItHasSettled)
{
    for (const double pixels : {0.2, 0.5, 1.0, 2.0}) {
        InternalResolution resolution(wanted, 1.0);
        settled(resolution, 0.01, pixels);
        std::set<double> scales;
        for (int i = 0; i < 100; ++i)
            scales.insert(settled(resolution, 0.01, pixels, 1));
        EXPECT_EQ(scales.size(), 1u) << pixels;
    }
}

TEST(InternalResolution, ComesBackWhenThereIsRoomAgain)
{
    InternalResolution resolution(wanted, 1.0);
    settled(resolution, 0.02, 2.0);
    EXPECT_LT(resolution.scale(), 0.4);
    EXPECT_EQ(settled(resolution, 0.001, 0.02), 1.0);
}

TEST(InternalResolution, ReachesTheHighestScaleWhereMostTimeIsNotOfPixels)
{
    // 80 ms whatever the scale, and 20 more at 41 %, as on a CPU: 51 % would take 111 ms.
    const double pixels = 0.02 / (0.4096 * 0.4096);
    InternalResolution resolution(wanted, InternalResolution::lowest);
    EXPECT_NEAR(settled(resolution, 0.08, pixels), 0.512, 1e-6);
    EXPECT_NEAR(settled(resolution, 0.09, pixels), 0.4096, 1e-6);
}

TEST(InternalResolution, FallsByOneStepWhenOneIsEnoughAlthoughTimesComeLate)
{
    InternalResolution resolution(wanted, 0.512);
    settled(resolution, 0.0, 0.1 / (0.512 * 0.512), 20);
    ASSERT_NEAR(resolution.scale(), 0.512, 1e-6);
    // The two frames in flight are as slow as the one that made it fall.
    resolution.add(0.12);
    const double fallen = resolution.scale();
    EXPECT_NEAR(fallen, 0.4096, 1e-6);
    resolution.add(0.12);
    resolution.add(0.12);
    EXPECT_EQ(resolution.scale(), fallen);
}

TEST(InternalResolution, NeverDrawsLessThanItsLowest)
{
    InternalResolution resolution(wanted, 1.0);
    EXPECT_EQ(settled(resolution, 5.0, 5.0), InternalResolution::lowest);
}

TEST(ThinnedForScale, ThinsWithThePixelsUpToFourTimes)
{
    render::FrameSettings all;
    all.bladeShadows = true;
    const float threshold = all.lodThreshold;
    EXPECT_FLOAT_EQ(thinnedForScale(all, 1.0).lodThreshold, threshold);
    EXPECT_FLOAT_EQ(thinnedForScale(all, 0.5).lodThreshold, 2.0f * threshold);
    EXPECT_FLOAT_EQ(thinnedForScale(all, 0.2).lodThreshold, 4.0f * threshold);
    EXPECT_TRUE(thinnedForScale(all, 1.0).bladeShadows);
    EXPECT_FALSE(thinnedForScale(all, 0.5).bladeShadows);
}

} // namespace
} // namespace sward::view
