// Ribbons on the stalks of compound plants.
#include "shaders/shared/organ.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace sward::shared {
namespace {

Organ randomOrgan(tests::Dice& dice)
{
    Organ organ = {};
    organ.count = 1u + uint(dice.number(0.0f, 12.0f));
    // Heads stand at the tip.
    organ.place = dice.number(0.0f, 1.0f) < 0.2f
                      ? vec2(1.0f)
                      : vec2(dice.number(0.0f, 1.0f), dice.number(0.0f, 1.0f));
    organ.pitch = vec2(dice.number(0.0f, 3.14f), dice.number(0.0f, 3.14f));
    organ.size = vec2(dice.number(0.01f, 1.0f), dice.number(0.01f, 1.0f));
    organ.azimuth = dice.number(-6.3f, 6.3f);
    organ.turn = dice.number(-6.3f, 6.3f);
    organ.bend = dice.number(-2.0f, 2.0f);
    organ.leg = legLength(organ.bend);
    organ.variation = dice.number(0.0f, 1.0f);
    return organ;
}

// A stalk in any pose, on ground of any direction.
PosedBlade randomStalk(tests::Dice& dice)
{
    Blade blade = {};
    blade.root = 0.1f * dice.direction();
    blade.up = dice.direction();
    blade.facing = float(uint(dice.number(0.0f, 255.9f))) * (twoPi / 256.0f);
    blade.height = dice.number(0.02f, 2.0f);
    blade.hash = uint(dice.number(0.0f, 15.9f));
    // Every tenth stands upright, as all do before they have moved.
    if (dice.number(0.0f, 1.0f) < 0.1f)
        return posedBlade(blade, stateOfTurn(vec2(0.0f), 0.0f));
    const vec3 front = frontOf(blade.up, widthAxis(blade.up, blade.facing));
    return posedBlade(blade,
                      stateOf(blade.up, front, keptAbove(blade.up, front, dice.direction()), 0.0f));
}

float lengthOf(const PosedBlade& posed)
{
    float sum = 0.0f;
    vec3 before = posed.v0;
    for (int i = 1; i <= 200; ++i) {
        const vec3 here = bezierPoint(posed.v0, posed.v1, posed.v2, float(i) / 200.0f);
        sum += length(here - before);
        before = here;
    }
    return sum;
}

float distanceTo(const PosedBlade& curve, vec3 place)
{
    float nearest = std::numeric_limits<float>::max();
    for (int i = 0; i <= 1000; ++i)
        nearest = std::min(
            nearest, length(bezierPoint(curve.v0, curve.v1, curve.v2, float(i) / 1000.0f) - place));
    return nearest;
}

TEST(Organ, ItsRibbonsBeginOnTheStalkInAnyPose)
{
    tests::Dice dice(21);
    for (int run = 0; run < 2000; ++run) {
        const Organ organ = randomOrgan(dice);
        const PosedBlade stalk = randomStalk(dice);
        const uint within = uint(dice.number(0.0f, float(organ.count) - 0.1f));
        const PosedBlade ribbon = posedRibbon(stalk, organ, within + 1u, within);
        EXPECT_LT(distanceTo(stalk, ribbon.v0), 2e-3f * stalk.blade.height);
    }
}

TEST(Organ, ItsRibbonsKeepTheirLengthAboveTheGround)
{
    tests::Dice dice(22);
    int free = 0;
    for (int run = 0; run < 5000; ++run) {
        const Organ organ = randomOrgan(dice);
        const PosedBlade stalk = randomStalk(dice);
        const PosedBlade ribbon = posedRibbon(stalk, organ, 1u, 0u);
        const vec3 up = stalk.blade.up;
        const float rounding = 1e-5f * (1.0f + stalk.blade.height);
        // All control points above the ground plane: the whole curve is.
        ASSERT_GE(dot(up, ribbon.v1 - stalk.blade.root), -rounding);
        ASSERT_GE(dot(up, ribbon.v2 - stalk.blade.root), -rounding);
        ASSERT_NEAR(length(ribbon.axis), 1.0f, 1e-5f);
        const float share = lengthOf(ribbon) / ribbon.blade.height;
        const bool isLifted = dot(up, ribbon.v1 - stalk.blade.root) < rounding ||
                              dot(up, ribbon.v2 - stalk.blade.root) < rounding;
        if (isLifted) {
            ASSERT_LT(share, 1.01f);
            continue;
        }
        ++free;
        ASSERT_NEAR(share, 1.0f, 3e-3f);
        ASSERT_NEAR(dot(ribbon.axis, ribbon.v2 - ribbon.v0) / ribbon.blade.height, 0.0f, 1e-4f);
    }
    EXPECT_GT(free, 2000);
}

TEST(Organ, TheLegsOfACurveGiveItItsLength)
{
    for (float bend = -3.0f; bend <= 3.0f; bend += 0.1f) {
        const float leg = legLength(bend);
        PosedBlade curve = {};
        curve.v1 = vec3(0.0f, leg, 0.0f);
        curve.v2 = curve.v1 + leg * vec3(std::sin(bend), std::cos(bend), 0.0f);
        EXPECT_NEAR(lengthOf(curve), 1.0f, std::abs(bend) < 1.6f ? 2e-4f : 1e-2f) << bend;
    }
}

TEST(Organ, IsFoundByTheNumberOfARibbon)
{
    std::array<Organ, 4> kinds = {};
    const std::array<uint, 4> counts{7, 3, 1, 5};
    for (std::size_t i = 0; i < kinds.size(); ++i)
        kinds[i].count = counts[i];
    OrganTable table;
    table.at = kinds.data();
    Species species = {};
    species.firstOrgan = 1;
    species.organKinds = 3;
    uint number = 1;
    for (uint kind = 1; kind < 4; ++kind)
        for (uint i = 0; i < counts[kind]; ++i, ++number) {
            uint within = 99;
            EXPECT_EQ(organOf(table, species, number, within), kind);
            EXPECT_EQ(within, i);
        }
    // A number beyond the last stays with the last organ.
    uint within = 0;
    EXPECT_EQ(organOf(table, species, 60u, within), 3u);

    Blade blade = {};
    blade.clump = 5;
    EXPECT_EQ(ribbonNumber(species, blade), 5u);
    species.organKinds = 0;
    EXPECT_EQ(ribbonNumber(species, blade), 0u) << "an ordinary blade keeps its clump";
}

TEST(Organ, PlantsDifferAndAPlantStaysTheSame)
{
    tests::Dice dice(23);
    Organ organ = randomOrgan(dice);
    organ.variation = 1.0f;
    const PosedBlade stalk = randomStalk(dice);
    PosedBlade other = stalk;
    other.blade.hash ^= 1u;
    const PosedBlade once = posedRibbon(stalk, organ, 1u, 0u);
    EXPECT_EQ(once.v2, posedRibbon(stalk, organ, 1u, 0u).v2);
    EXPECT_NE(once.v2, posedRibbon(other, organ, 1u, 0u).v2);
    EXPECT_NE(once.v2, posedRibbon(stalk, organ, 2u, 0u).v2);
}

} // namespace
} // namespace sward::shared
