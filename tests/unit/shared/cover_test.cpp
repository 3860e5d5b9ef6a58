// Light below grass, and leaf area by height.

#include "core/random.h"
#include "shaders/shared/cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sward::shared {
namespace {

TEST(Cover, LeavesAllLightWhereThereIsNoGrass)
{
    EXPECT_EQ(sunBelow(0.0f, 0.7f), 1.0f);
    EXPECT_EQ(sunBelow(0.0f, -1.0f), 1.0f);
    EXPECT_EQ(skyBelow(0.0f), 1.0f);
    EXPECT_EQ(leafAreaAt(Cover{}, vec3(3.0f)), 0.0f);
}

TEST(Cover, TakesFromTheSkyWhatItTakesFromSunsAllOverIt)
{
    for (const float leafArea : {0.1f, 0.3f, 1.0f, 2.0f, 4.0f}) {
        // Cosine-weighted over the hemisphere.
        double sum = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps;
            sum += 2.0 * cosine / steps *
                   std::exp(-static_cast<double>(leafExtinction * leafArea) / cosine);
        }
        EXPECT_NEAR(skyBelow(leafArea), sum, 0.03) << leafArea;
    }
}

TEST(Cover, ShadesTheLowerPartsOfABladeMore)
{
    EXPECT_EQ(leafShareAbove(0.0f), 1.0f);
    EXPECT_EQ(leafShareAbove(1.0f), 0.0f);
    for (int i = 0; i <= 100; ++i) {
        const float t = static_cast<float>(i) / 100.0f;
        const float u = 1.0f - t;
        // Area above t: of a triangle, and of a blade that tapers from half its length.
        const float pointed = u * u;
        const float halfway = (t < 0.5f ? 0.75f - t : u * u) / 0.75f;
        EXPECT_NEAR(leafShareAbove(t), pointed, 0.11f) << t;
        EXPECT_NEAR(leafShareAbove(t), halfway, 0.05f) << t;
    }
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
    std::vector<float> values;
    for (uint z = 0; z < cover.countZ; ++z)
        for (uint y = 0; y < cover.countY; ++y)
            for (uint x = 0; x < cover.countX; ++x)
                values.push_back(truth(cover.low + 0.5f * vec3(float(x), float(y), float(z))));
    cover.leafArea.at = values.data();

    const vec3 size(2.0f, 1.0f, 1.5f);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const vec3 p = cover.low + size * vec3(static_cast<float>(uniform(4, i, 0)),
                                               static_cast<float>(uniform(4, i, 1)),
                                               static_cast<float>(uniform(4, i, 2)));
        EXPECT_NEAR(leafAreaAt(cover, p), truth(p), 1e-5f);
    }
    // Its last corner, and what is outside: as at its surface.
    EXPECT_NEAR(leafAreaAt(cover, cover.low + size), truth(cover.low + size), 1e-5f);
    EXPECT_EQ(leafAreaAt(cover, cover.low + 3.0f * size), leafAreaAt(cover, cover.low + size));
}

} // namespace
} // namespace sward::shared
