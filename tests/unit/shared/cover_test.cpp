// Light below grass, and leaf area by height.

#include "core/random.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sward::shared {
namespace {

TEST(Cover, LeavesAllLightWhereThereIsNoGrass)
{
    EXPECT_EQ(sunBelow(0.3f, 0.0f, 0.7f), 1.0f);
    EXPECT_EQ(sunBelow(0.3f, 0.0f, -1.0f), 1.0f);
    EXPECT_EQ(skyBelow(0.0f), 1.0f);
    EXPECT_EQ(leafAreaAt(Cover{}, vec3(3.0f)), 0.0f);
}

TEST(Cover, TakesFromTheSkyWhatItTakesFromSunsAllOverIt)
{
    for (const float leafArea : {0.1f, 0.3f, 1.0f, 2.0f, 4.0f}) {
        // Cosine-weighted over the hemisphere: a leaf that faces the sky. One that stands sees more
        // of the flat rays, which more leaves cross.
        double level = 0.0;
        double upright = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps;
            const double sine = std::sqrt(1.0 - cosine * cosine);
            const auto left =
                static_cast<double>(sunBelow(0.3f, leafArea, static_cast<float>(cosine)));
            level += 2.0 * cosine / steps * left;
            upright += 4.0 / std::numbers::pi * sine / steps * left;
        }
        EXPECT_LT(skyBelow(leafArea), level + 0.03) << leafArea;
        EXPECT_GT(skyBelow(leafArea), upright - 0.13) << leafArea;
    }
}

TEST(Cover, ProjectsLeavesAsMeasured)
{
    // Mean |normal · ray| of the meadow's blades by elevation; see SunShare of the unit tests.
    const std::pair<float, float> measured[] = {{90.0f, 0.30f}, {75.0f, 0.33f}, {60.0f, 0.40f},
                                                {45.0f, 0.47f}, {30.0f, 0.53f}, {15.0f, 0.565f}};
    for (const auto& [elevation, projection] : measured)
        EXPECT_NEAR(leafProjectionAlong(0.3f, std::sin(radians(elevation))), projection, 0.02f)
            << elevation;
}

TEST(Cover, UndergrowthCoversTheGroundAsTheMeadowDoes)
{
    Cover cover = {};
    cover.undergrowth = vec3(0.05f, 0.1f, 0.02f);
    cover.sward = vec3(0.1f, 0.2f, 0.04f);
    cover.thatch = 1.0f;
    const vec3 white(1.0f);
    const auto under = [&](float leafArea) {
        return groundUnder(cover, white, vec3(1.0f), leafArea);
    };
    EXPECT_EQ(under(0.0f), white);
    // A white ground does not shine through a closed sward: at most a twentieth of each channel.
    const auto largest = [](vec3 v) { return std::max({v.x, v.y, v.z}); };
    EXPECT_LT(largest(abs(under(5.0f) - cover.undergrowth)), 0.05f);
    for (float leafArea = 0.1f; leafArea < 5.0f; leafArea += 0.1f)
        EXPECT_LT(under(leafArea).x, under(leafArea - 0.1f).x) << leafArea;
    // Nothing stands for blades where none is missing; all of the ground does where all are.
    EXPECT_EQ(swardShare(cover, 5.0f, 1.0f), 0.0f);
    EXPECT_GT(swardShare(cover, 5.0f, 1000.0f), 0.95f);
    EXPECT_EQ(swardShare(cover, 0.0f, 1000.0f), 0.0f);
    cover.thatch = 0.0f;
    EXPECT_EQ(under(5.0f), white);
    EXPECT_EQ(swardShare(cover, 5.0f, 1000.0f), 0.0f);
}

TEST(Noise, SlopeIsTheDerivativeOfTheValue)
{
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto at = [&](std::uint32_t axis) {
            return static_cast<float>(40.0 * uniform(7, i, axis) - 20.0);
        };
        const vec3 p(at(0), at(1), at(2));
        const vec4 slope = valueNoiseSlope(p);
        EXPECT_NEAR(slope.w, valueNoise(p), 1e-6f);
        for (int axis = 0; axis < 3; ++axis) {
            vec3 step(0.0f);
            step[axis] = 0.004f;
            const float secant = (valueNoise(p + step) - valueNoise(p - step)) / 0.008f;
            EXPECT_NEAR(slope[axis], secant, 0.02f) << i << " along " << axis;
        }
    }
}

TEST(Cover, ReadsTheLeafAreaAboveAHeight)
{
    Cover cover = {};
    const auto above = [](float step) { return (16.0f - step) * (16.0f - step) / 256.0f; };
    for (uint i = 0; i < heightSteps; i += 2)
        cover.leaves[i / 2] = packHalf2x16(
            vec2(i == 0 ? 0.25f : 1.0f - float(i) / 16.0f, 1.0f - float(i + 1) / 16.0f));
    EXPECT_EQ(leafProjectionOf(cover), 0.25f);
    for (uint i = 0; i < heightSteps; ++i) {
        EXPECT_NEAR(leafShareAbove(cover, float(i)), above(float(i)), 1e-3f) << i;
        EXPECT_NEAR(leafShareAbove(cover, float(i) + 0.5f), above(float(i) + 0.5f), 1e-3f) << i;
    }
    EXPECT_EQ(leafShareAbove(cover, -1.0f), 1.0f);
    EXPECT_EQ(leafShareAbove(cover, 16.0f), 0.0f);
    EXPECT_EQ(leafShareAbove(cover, 100.0f), 0.0f);
    // Grass of half the height has twice the steps per metre.
    cover.stepsPerMetre = 16.0f;
    EXPECT_EQ(heightStepsPerMetre(cover, vec3(3.0f, 1.5f, 1.0f)), 32.0f);
    EXPECT_EQ(heightStepsPerMetre(cover, vec3(0.0f)), 16.0f);
}

TEST(Cover, ReadsWhatIsLinearInSpaceAsItIs)
{
    Cover cover = {};
    cover.low = vec3(-2.0f, 1.0f, 5.0f);
    cover.cellsPerMetre = 2.0f;
    cover.countX = 5;
    cover.countY = 3;
    cover.countZ = 4;
    const auto truth = [](vec3 p) { return 3.0f + 0.5f * p.x - 0.25f * p.y + 0.75f * p.z; };
    std::vector<uint> values;
    for (uint z = 0; z < cover.countZ; ++z)
        for (uint y = 0; y < cover.countY; ++y)
            for (uint x = 0; x < cover.countX; ++x)
                values.push_back(
                    packGrass(truth(cover.low + 0.5f * vec3(float(x), float(y), float(z))), 0.5f,
                              0.25f * float(x)));
    cover.grass.at = values.data();

    const vec3 size(2.0f, 1.0f, 1.5f);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const vec3 p = cover.low + size * vec3(static_cast<float>(uniform(4, i, 0)),
                                               static_cast<float>(uniform(4, i, 1)),
                                               static_cast<float>(uniform(4, i, 2)));
        EXPECT_NEAR(leafAreaAt(cover, p), truth(p), 4e-3f); // halves
        EXPECT_NEAR(grassAt(cover, p).y, 0.5f * truth(p), 4e-3f);
        EXPECT_NEAR(toneOf(grassAt(cover, p)), 0.5f * (p.x - cover.low.x), 0.04f);
    }
    // Its last corner, and what is outside: as at its surface.
    EXPECT_NEAR(leafAreaAt(cover, cover.low + size), truth(cover.low + size), 4e-3f);
    EXPECT_EQ(leafAreaAt(cover, cover.low + 3.0f * size), leafAreaAt(cover, cover.low + size));
}

} // namespace
} // namespace sward::shared
