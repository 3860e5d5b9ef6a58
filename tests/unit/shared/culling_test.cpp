#include "shaders/shared/bezier.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/visibility.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::shared {
namespace {

// The planes of a cube of half side 1 around the origin, normals inward.
const std::array<vec4, 6> cubePlanes{vec4(1, 0, 0, 1),  vec4(-1, 0, 0, 1), vec4(0, 1, 0, 1),
                                     vec4(0, -1, 0, 1), vec4(0, 0, 1, 1),  vec4(0, 0, -1, 1)};

TEST(FrustumCulling, EachPlaneAloneCutsWhatLiesBehindIt)
{
    for (std::size_t p = 0; p < 6; ++p) {
        const vec3 inward(cubePlanes[p].x, cubePlanes[p].y, cubePlanes[p].z);
        const vec3 outside = -1.5f * inward;
        const vec3 inside = -0.5f * inward;
        EXPECT_TRUE(curveOutside(cubePlanes[p], outside, outside, outside, 0.1f)) << p;
        EXPECT_FALSE(curveOutside(cubePlanes[p], outside, outside, inside, 0.1f)) << p;
        EXPECT_FALSE(curveOutside(cubePlanes[p], outside, inside, outside, 0.1f)) << p;
        EXPECT_FALSE(curveOutside(cubePlanes[p], outside, outside, outside, 0.6f)) << p;
        for (std::size_t other = 0; other < 6; ++other)
            if (other != p) {
                EXPECT_FALSE(curveOutside(cubePlanes[other], outside, outside, outside, 0.1f))
                    << p << " and " << other;
            }
    }
}

TEST(FrustumCulling, NeverCutsACurveWithAPointInside)
{
    tests::Dice dice(1);
    int cut = 0;
    for (int i = 0; i < 200'000; ++i) {
        const vec3 v0 = 2.0f * dice.direction();
        const vec3 v1 = v0 + dice.direction();
        const vec3 v2 = v1 + dice.direction();
        const float width = dice.number(0.0f, 0.3f);
        const vec3 axis = dice.direction();
        bool isCut = false;
        for (const vec4& plane : cubePlanes)
            isCut = isCut || curveOutside(plane, v0, v1, v2, 0.5f * width);
        cut += isCut ? 1 : 0;
        if (!isCut)
            continue;
        for (float t = 0.0f; t <= 1.0f; t += 0.125f)
            for (const float side : {-0.5f, 0.0f, 0.5f}) {
                const vec3 p = bezierPoint(v0, v1, v2, t) + side * width * axis;
                const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
                ASSERT_GE(largest, 1.0f - 1e-5f);
            }
    }
    EXPECT_GT(cut, 10'000);
}

TEST(BoxCulling, IsConservativeAndCutsWhatIsClearlyOutside)
{
    tests::Dice dice(2);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 low = 2.0f * dice.direction();
        const vec3 high = low + vec3(dice.number(0, 1), dice.number(0, 1), dice.number(0, 1));
        const vec3 inside =
            low + (high - low) * vec3(dice.number(0, 1), dice.number(0, 1), dice.number(0, 1));
        for (const vec4& plane : cubePlanes)
            if (planeDistance(plane, inside) >= 0.0f) {
                ASSERT_FALSE(boxOutside(plane, low, high));
            }
        ASSERT_TRUE(boxOutside(vec4(1, 0, 0, 1), low - vec3(10, 0, 0), high - vec3(10, 0, 0)));
    }
}

TEST(OrientationCulling, MeasuresTheAngleToTheRay)
{
    const vec3 eye(0, 0, 5);
    const vec3 root(0.0f);
    EXPECT_FLOAT_EQ(edgeOnCosine(eye, root, vec3(0, 0, 1)), 1.0f);
    EXPECT_FLOAT_EQ(edgeOnCosine(eye, root, vec3(0, 0, -1)), 1.0f);
    EXPECT_FLOAT_EQ(edgeOnCosine(eye, root, vec3(1, 0, 0)), 0.0f);
    EXPECT_NEAR(edgeOnCosine(eye, root, vec3(0.6f, 0, 0.8f)), 0.8f, 1e-6f);
    EXPECT_EQ(edgeOnCosine(root, root, vec3(1, 0, 0)), 0.0f) << "an eye on the root sees no edge";
}

TEST(BucketCulling, LeavesOutMoreWithDistanceInSteps)
{
    const float last = 10.0f;
    for (float distance = 0.0f; distance < 12.0f; distance += 0.37f) {
        int kept = 0;
        for (int i = 0; i < 1000; ++i)
            kept += bucketsKeep(5.0f, last, distance, (float(i) + 0.5f) / 1000.0f) ? 1 : 0;
        EXPECT_EQ(kept % 200, 0);
        EXPECT_EQ(kept,
                  int(std::clamp(std::floor(5.0f * (1.0f - distance / last)), 0.0f, 5.0f)) * 200);
    }
    EXPECT_TRUE(bucketsKeep(0.0f, 0.0f, 1e6f, 0.999f)) << "without buckets all stay";
}

TEST(LevelOfDetail, KeepsTheCoveredAreaAtEveryShare)
{
    for (const float share : {lodFullShare, 1.05f, 1.0f, 0.9f, 0.5f, 0.1f, 0.01f, 1.0f / 256.0f}) {
        double area = 0.0;
        constexpr int ranks = 1'000'000;
        for (int i = 0; i < ranks; ++i)
            area += double(lodWidthFactor((float(i) + 0.5f) / float(ranks), share));
        EXPECT_NEAR(area / ranks, 1.0, 2e-3) << "share " << share;
    }
}

TEST(LevelOfDetail, ChangesContinuouslyAndKeepsTheCoarseOnes)
{
    tests::Dice dice(3);
    for (int i = 0; i < 50'000; ++i) {
        const float rank = dice.number(0.0f, 1.0f);
        const float pixels = dice.number(0.005f, 1.5f);
        const float here = lodWidthFactor(rank, lodShare(pixels, 1.0f));
        const float near = lodWidthFactor(rank, lodShare(pixels * 1.001f, 1.0f));
        // Covered width on the screen moves by at most a few per cent of a pixel for 0.1 % of
        // distance.
        ASSERT_LT(std::abs(near * pixels * 1.001f - here * pixels), 0.06f);
        // A blade of lower rank is drawn whenever one of higher rank is.
        if (here > 0.0f) {
            ASSERT_GT(lodWidthFactor(0.5f * rank, lodShare(pixels, 1.0f)), 0.0f);
        }
    }
    EXPECT_EQ(lodWidthFactor(0.9999f, lodShare(2.0f, 1.0f)), 1.0f);
    EXPECT_GT(lodShare(1e-9f, 1.0f), 0.0f);
}

TEST(LeafAreaLimit, OfWhatIsInARaysWaySoMuchIsLeftAndNeverLess)
{
    tests::Dice dice(5);
    for (int i = 0; i < 100'000; ++i) {
        const float most = dice.number(1.0f, 64.0f);
        const float leafArea = dice.number(0.0f, 50.0f);
        const float cosine = dice.number(0.0f, 1.0f);
        const float pixels = dice.number(0.01f, 8.0f);
        const float share = leafAreaShare(most, leafArea, cosine, pixels);
        const float wide = std::pow(std::max(pixels, 1.0f), 4.0f);
        const float inTheWay = leafExtinction * leafArea / std::max(cosine, flattestRay);
        EXPECT_GE(share * inTheWay, 0.999f * std::min(most * wide, inTheWay));
        if (share < 0.999f * lodFullShare) {
            EXPECT_LE(share * inTheWay, std::max(1.001f * most * wide, inTheWay / 255.0f));
        }
        // The function is continuous in all arguments.
        EXPECT_NEAR(leafAreaShare(most, 1.001f * leafArea, cosine, pixels), share, 0.002f * share);
        EXPECT_NEAR(leafAreaShare(most, leafArea, 1.001f * cosine, pixels), share, 0.002f * share);
        EXPECT_NEAR(leafAreaShare(most, leafArea, cosine, 1.001f * pixels), share, 0.008f * share);
    }
}

TEST(LeafAreaLimit, KeepTheFirstBladesAsTheyAreAndLetTheLastFade)
{
    for (const float share : {0.01f, 0.3f, 1.0f, 1.05f}) {
        EXPECT_EQ(leafAreaWeight(0.85f * share, share), 1.0f);
        EXPECT_EQ(leafAreaWeight(1.001f * share, share), 0.0f);
        float before = 1.0f;
        for (float rank = 0.0f; rank <= 1.1f * share; rank += 1e-3f * share) {
            const float weight = leafAreaWeight(rank, share);
            EXPECT_LE(weight, before);
            EXPECT_LE(before - weight, 0.011f);
            before = weight;
        }
    }
    EXPECT_EQ(leafAreaWeight(0.9999f, lodFullShare), 1.0f);
}

TEST(LeafAreaLimit, RiseBySoMuchAsMoreIsLeftOutAndNeverJump)
{
    tests::Dice dice(6);
    float highest = 1.0f;
    for (int i = 0; i < 100'000; ++i) {
        const float one = std::exp(dice.number(-8.0f, 2.0f));
        const float share = dice.number(1.0f / 256.0f, lodFullShare);
        const float spread = dice.number(0.0f, 1.0f);
        const float rise = heightCompensation(share, one, spread);
        // The only allowed jump is the rounding of lengths to 1/1024.
        constexpr float step = 1.001f / 1024.0f;
        EXPECT_GE(rise, 1.0f);
        EXPECT_LE(rise, maxHeightCompensation);
        EXPECT_LE(heightCompensation(1.01f * share, one, spread), rise)
            << "share " << share << ", one " << one;
        EXPECT_NEAR(heightCompensation(1.001f * share, one, spread), rise, step);
        EXPECT_NEAR(heightCompensation(share, 1.001f * one, spread), rise, step);
        EXPECT_NEAR(heightCompensation(share, one, 0.999f * spread), rise, step);
        // More light if more is left out, no extra light if everything is drawn.
        const float light = leafAreaLight(share, spread);
        EXPECT_LE(light, leafAreaLight(std::min(1.01f * share, 1.0f), spread));
        EXPECT_LE(light, leafAreaLight(share, std::min(spread + 0.01f, 1.0f)));
        EXPECT_GE(light, std::min(share, 1.0f));
        // As a half float it is the same to the bit.
        VisibleBlade visible = {};
        visible.factors = packFactors(1.5f, rise);
        EXPECT_EQ(heightFactorOf(visible), rise);
        EXPECT_EQ(widthFactorOf(visible), 1.5f);
        highest = std::max(highest, rise);
    }
    EXPECT_NEAR(highest, maxHeightCompensation, 0.5f / 1024.0f);
    EXPECT_EQ(heightCompensation(lodFullShare, 0.1f, 0.5f), 1.0f);
    EXPECT_EQ(leafAreaLight(lodFullShare, 0.5f), 1.0f);
}

TEST(LeafShare, HeightsAreThoseThatHaveIt)
{
    for (float share = 0.0f; share <= 1.0f; share += 0.01f)
        EXPECT_NEAR(std::pow(heightWithLeafShare(share), 1.5f), share, 1e-5f);
}

TEST(LevelOfDetail, SwitchedOffDrawsEveryBladeAsWideAsItIs)
{
    Eyepoint view = {};
    view.pixelsPerUnit = 500.0f;
    view.lodWidth = 0.02f;
    view.lodThreshold = 0.0f;
    Blade blade = {};
    blade.height = 0.5f;
    tests::Dice dice(4);
    for (int i = 0; i < 10'000; ++i) {
        const float distance = dice.number(0.0f, 1e4f);
        EXPECT_EQ(drawnSize(view, noLeafAreaLimit(), blade, dice.number(0.0f, 1.0f), distance)
                      .widthFactor,
                  1.0f);
    }
}

TEST(BoxDistance, IsZeroInsideAndEuclideanOutside)
{
    const vec3 low(-1.0f);
    const vec3 high(1.0f);
    EXPECT_EQ(boxDistance(vec3(0.5f), low, high), 0.0f);
    EXPECT_EQ(boxDistance(vec3(4, 0, 0), low, high), 3.0f);
    EXPECT_FLOAT_EQ(boxDistance(vec3(2, 2, 2), low, high), std::sqrt(3.0f));
}

} // namespace
} // namespace sward::shared
