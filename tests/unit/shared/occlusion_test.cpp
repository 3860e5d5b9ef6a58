#include "shaders/shared/occlusion.h"
#include "unit/shared/random_vectors.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

constexpr uvec2 size(317, 181);

// Reversed Z: 1 at the near plane, 0 at infinity.
mat4 projection()
{
    const float scale = 1.0f / std::tan(0.4f);
    mat4 m(0.0f);
    m[0][0] = scale * float(size.y) / float(size.x);
    m[1][1] = -scale;
    m[2][3] = -1.0f;
    m[3][2] = 0.1f;
    return m;
}

TEST(Occlusion, ABoxOnTheScreenHoldsAllThatIsInIt)
{
    tests::Dice dice(5);
    int known = 0;
    for (int i = 0; i < 20'000; ++i) {
        const mat4 view = projection() * lookAt(3.0f * dice.direction(), dice.direction() * 0.3f,
                                                vec3(0.1f, 1.0f, 0.2f));
        const vec3 a = 2.0f * dice.direction();
        const vec3 b = a + 0.7f * dice.direction();
        const vec3 low = min(a, b);
        const vec3 high = max(a, b);
        const ScreenBox box = screenBoxOf(view, size, low, high);
        for (int k = 0; k < 8; ++k) {
            const vec3 share = 0.5f + 0.5f * dice.direction();
            const vec4 clip = view * vec4(mix(low, high, share), 1.0f);
            if (clip.w <= 0.1f)
                continue; // behind the near plane nothing is said, and nothing seen
            if (!box.isKnown)
                continue;
            ++known;
            EXPECT_LE(clip.z / clip.w, box.nearest * 1.00001f);
            const vec2 place = (vec2(clip.x, clip.y) / clip.w * 0.5f + 0.5f) * vec2(size);
            if (place.x < 0.0f || place.y < 0.0f || place.x >= float(size.x) ||
                place.y >= float(size.y))
                continue;
            EXPECT_GE(int(place.x), box.low.x);
            EXPECT_LE(int(place.x), box.high.x);
            EXPECT_GE(int(place.y), box.low.y);
            EXPECT_LE(int(place.y), box.high.y);
        }
    }
    EXPECT_GT(known, 50'000);
}

/// Points within the margin of a curve are in its box. The box is at most that of the control
/// points plus the margin, except for rounding of the margin.
TEST(Occlusion, ACurveOnTheScreenHoldsAllThatIsNearIt)
{
    tests::Dice dice(7);
    int known = 0;
    double areaOfCurves = 0.0;
    double areaOfBoxes = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const mat4 view = projection() * lookAt(4.0f * dice.direction(), dice.direction() * 0.3f,
                                                vec3(0.1f, 1.0f, 0.2f));
        const vec3 v0 = 1.5f * dice.direction();
        const vec3 v1 = v0 + 0.4f * dice.direction();
        const vec3 v2 = v1 + 0.4f * dice.direction();
        const float margin = 0.1f * std::abs(dice.direction().x);
        const ScreenBox box = screenBoxOfCurve(view, size, v0, v1, v2, margin);
        if (!box.isKnown)
            continue;
        for (int k = 0; k < 8; ++k) {
            const float t = 0.5f + 0.5f * dice.direction().x;
            const vec3 place = mix(mix(v0, v1, t), mix(v1, v2, t), t) + margin * dice.direction();
            const vec4 clip = view * vec4(place, 1.0f);
            ASSERT_GT(clip.w, 0.0f);
            ++known;
            EXPECT_LE(clip.z / clip.w, box.nearest * 1.00001f);
            const vec2 seen = (vec2(clip.x, clip.y) / clip.w * 0.5f + 0.5f) * vec2(size);
            if (seen.x < 0.0f || seen.y < 0.0f || seen.x >= float(size.x) ||
                seen.y >= float(size.y))
                continue;
            EXPECT_GE(int(seen.x), box.low.x);
            EXPECT_LE(int(seen.x), box.high.x);
            EXPECT_GE(int(seen.y), box.low.y);
            EXPECT_LE(int(seen.y), box.high.y);
        }
        const vec3 low = min(min(v0, v1), v2) - margin;
        const vec3 high = max(max(v0, v1), v2) + margin;
        const ScreenBox around = screenBoxOf(view, size, low, high);
        if (!around.isKnown)
            continue;
        const auto areaOf = [](const ScreenBox& of) {
            return double(of.high.x - of.low.x + 1) * double(of.high.y - of.low.y + 1);
        };
        areaOfCurves += areaOf(box);
        areaOfBoxes += areaOf(around);
    }
    EXPECT_GT(known, 50'000);
    EXPECT_LT(areaOfCurves, 0.8 * areaOfBoxes);
}

TEST(Occlusion, OfABoxAroundTheEyeNothingIsSaid)
{
    const mat4 view = projection() * lookAt(vec3(0.0f), vec3(0, 0, -1), vec3(0, 1, 0));
    EXPECT_FALSE(screenBoxOf(view, size, vec3(-1.0f), vec3(1.0f)).isKnown);
    EXPECT_FALSE(screenBoxOf(view, size, vec3(-1, -1, -1), vec3(1.0f, 1.0f, -0.05f)).isKnown);
    EXPECT_TRUE(screenBoxOf(view, size, vec3(-1, -1, -4), vec3(1, 1, -3)).isKnown);
    const vec3 before(0.0f, 0.0f, -3.0f);
    EXPECT_FALSE(screenBoxOfCurve(view, size, before, vec3(0.0f), before, 0.1f).isKnown);
    EXPECT_FALSE(screenBoxOfCurve(view, size, before, before, before, 3.0f).isKnown);
    EXPECT_TRUE(screenBoxOfCurve(view, size, before, before, before, 0.1f).isKnown);
}

TEST(Occlusion, CellsCoverEveryPixelAndEndAtOne)
{
    for (const uint pixels : {1u, 3u, 4u, 5u, 181u, 1920u, 16'384u}) {
        uint level = 0;
        for (; pyramidCells(pixels, level) > 1; ++level)
            EXPECT_GE(pyramidCells(pixels, level) << (pyramidFactorBits * (level + 1)), pixels);
        EXPECT_LT(level, maxPyramidLevels);
    }
}

TEST(Occlusion, AFewCellsAreEnoughForAnyBox)
{
    tests::Dice dice(6);
    for (int i = 0; i < 10'000; ++i) {
        ScreenBox box = {};
        box.low = ivec2(int(800.0f + 799.0f * dice.direction().x),
                        int(400.0f + 399.0f * dice.direction().y));
        box.high = box.low + ivec2(int(600.0f * std::abs(dice.direction().x)),
                                   int(30.0f * std::abs(dice.direction().y)));
        const uint level = pyramidLevelFor(box, 6);
        const uint bits = pyramidFactorBits * (level + 1);
        EXPECT_LE((box.high.x >> bits) - (box.low.x >> bits), pyramidReach - 1);
        EXPECT_LE((box.high.y >> bits) - (box.low.y >> bits), pyramidReach - 1);
        if (level > 0) {
            const uint finer = bits - pyramidFactorBits;
            EXPECT_TRUE((box.high.x >> finer) - (box.low.x >> finer) >= pyramidReach ||
                        (box.high.y >> finer) - (box.low.y >> finer) >= pyramidReach);
        }
        // With fewer levels use the coarsest.
        EXPECT_EQ(pyramidLevelFor(box, 2), std::min(level, 1u));
    }
}

} // namespace
} // namespace sward::shared
