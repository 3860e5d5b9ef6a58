#include "shaders/shared/wind.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

namespace sward::shared {
namespace {

Wind someWind()
{
    return {normalize(vec3(0.8f, 0.0f, 0.6f)), 2.0f, 7.0f, 2.5f, 3.0f, 0.6f};
}

TEST(Wind, BlowsAlongItsDirectionAndIsBounded)
{
    const Wind wind = someWind();
    tests::Dice dice(1);
    for (int i = 0; i < 20'000; ++i) {
        const vec3 w = windAt(wind, 40.0f * dice.direction(), dice.number(0, 100));
        ASSERT_GE(dot(w, wind.direction), -1e-6f);
        ASSERT_LT(length(cross(w, wind.direction)), 1e-5f);
        ASSERT_LE(length(w), 2.0f * wind.strength);
    }
}

TEST(Wind, IsContinuousInSpaceAndTime)
{
    const Wind wind = someWind();
    tests::Dice dice(2);
    for (int i = 0; i < 20'000; ++i) {
        const vec3 place = 40.0f * dice.direction();
        const float time = dice.number(0, 100);
        const vec3 here = windAt(wind, place, time);
        ASSERT_LT(length(windAt(wind, place + 0.01f * dice.direction(), time) - here), 0.15f);
        ASSERT_LT(length(windAt(wind, place, time + 0.004f) - here), 0.15f);
    }
}

TEST(Wind, TravelsAgainstThePlaceAtItsSpeed)
{
    // What is here now was upstream before: with only gusts, exactly.
    Wind wind = someWind();
    wind.gustiness = 1.0f;
    tests::Dice dice(3);
    for (int i = 0; i < 1000; ++i) {
        const vec3 place = 10.0f * dice.direction();
        const vec3 before = windAt(wind, place - wind.direction * wind.speed, 4.0f);
        const vec3 now = windAt(wind, place, 5.0f);
        ASSERT_LT(length(now - before), 2e-3f);
    }
}

TEST(Wind, VariesOverTheField)
{
    const Wind wind = someWind();
    tests::Dice dice(4);
    float low = 1e9f;
    float high = 0.0f;
    for (int i = 0; i < 5000; ++i) {
        const float w = length(windAt(wind, 40.0f * dice.direction(), 3.0f));
        low = std::min(low, w);
        high = std::max(high, w);
    }
    EXPECT_LT(low, 0.2f * wind.strength);
    EXPECT_GT(high, 0.8f * wind.strength);
}

TEST(ValueNoise, MeetsItsLatticeAndStaysInRange)
{
    tests::Dice dice(5);
    for (int i = 0; i < 20'000; ++i) {
        const float n = valueNoise(50.0f * dice.direction());
        ASSERT_GE(n, 0.0f);
        ASSERT_LE(n, 1.0f);
    }
    for (int x = -3; x < 3; ++x)
        EXPECT_NEAR(valueNoise(vec3(float(x), 2.0f, -1.0f)), latticeValue(x, 2, -1), 1e-6f);
}

} // namespace
} // namespace sward::shared
