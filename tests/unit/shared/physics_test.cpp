#include "shaders/shared/physics.h"
#include "unit/shared/random_vectors.h"
#include "unit/shared/winds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::shared {
namespace {

Blade physicsBlade(tests::Dice& dice)
{
    Blade blade = {};
    blade.root = vec3(dice.number(-50, 50), dice.number(-50, 50), dice.number(-50, 50));
    blade.facing = dice.number(0.0f, twoPi);
    blade.up = dice.direction();
    blade.stiffness = dice.number(0.0f, 1.0f);
    blade.height = dice.number(0.1f, 1.0f);
    blade.width = 0.01f;
    return blade;
}

Gravity downward(float strength)
{
    return {vec3(0, -1, 0), strength, vec3(0.0f), 0.0f, forwardShare};
}

/// Waves and noise of this strength together.
tests::EnvironmentTables someWind(float strength)
{
    return tests::EnvironmentTables({tests::windSourceOf(windWave, 0.5f * strength),
                                     tests::windSourceOf(windNoise, 0.5f * strength)});
}

tests::EnvironmentTables still()
{
    return tests::EnvironmentTables();
}

constexpr float physicsRecovery = 6.0f;

vec3 physicsFront(const Blade& blade)
{
    return frontOf(blade.up, widthAxis(blade.up, blade.facing));
}

BladeState advanced(const Blade& blade, const BladeState& state, Gravity gravity,
                    const tests::EnvironmentTables& tables, float time, float elapsed)
{
    return advanceBlade(blade, tables.environment(gravity, physicsRecovery), noColliders(), state,
                        time, elapsed);
}

/// Of the tip, in heights.
float fromRest(const Blade& blade, const BladeState& state)
{
    return length(poseOfState(axesTowards(blade.up, physicsFront(blade)), state).v2 - blade.up);
}

/// State of a blade with its tip anywhere above its ground or on it.
BladeState stateTowards(const Blade& blade, const vec3& direction, float eta)
{
    const vec3 front = physicsFront(blade);
    return stateOf(blade.up, front, normalize(poseBlade(blade.up, front, direction).v2), eta);
}

float displacementAfter(const Blade& blade, BladeState& state, Gravity gravity,
                        const tests::EnvironmentTables& tables, float time, float elapsed)
{
    state = advanced(blade, state, gravity, tables, time, elapsed);
    return fromRest(blade, state);
}

TEST(BladeState, KeepsTheTipsDirectionWithinTheStatedError)
{
    tests::Dice dice(1);
    for (int i = 0; i < 100'000; ++i) {
        const Blade blade = physicsBlade(dice);
        const vec3 front = physicsFront(blade);
        // Every eighth lies on the ground, or nearly.
        vec3 direction = dice.direction();
        if (i % 8 == 0)
            direction -= blade.up * dot(direction, blade.up) * dice.number(0.99f, 1.0f);
        direction = normalize(direction);
        if (dot(direction, blade.up) < 0.0f)
            direction -= 2.0f * dot(direction, blade.up) * blade.up;
        const BladeState state = stateOf(blade.up, front, direction, 0.25f);
        const vec3 back = directionOf(blade.up, front, state);
        // Up and front are unit vectors and at right angles but for their own rounding.
        ASSERT_LT(length(back - direction), 2.0f * std::sqrt(2.0f) * turnMaxError + 1e-6f);
        ASSERT_NEAR(length(back), 1.0f, std::sqrt(2.0f) * turnMaxError);
        ASSERT_GE(dot(back, blade.up), -1e-6f);
        ASSERT_EQ(state.eta, 0.25f);
        // Stored again it is the same.
        ASSERT_EQ(stateOf(blade.up, front, back, 0.0f).turn, state.turn);
    }
}

TEST(BladeState, OfZerosStandsStraightUp)
{
    tests::Dice dice(11);
    for (int i = 0; i < 1000; ++i) {
        const Blade blade = physicsBlade(dice);
        EXPECT_EQ(directionOf(blade.up, physicsFront(blade), BladeState{0, 0.0f}), blade.up);
        EXPECT_EQ(stateOf(blade.up, physicsFront(blade), blade.up, 0.0f).turn, 0u);
    }
}

TEST(Pose, NeverPutsTheTipBelowTheBladesGround)
{
    tests::Dice dice(2);
    for (int i = 0; i < 100'000; ++i) {
        const Blade blade = physicsBlade(dice);
        // Every fourth tip is nearly straight below the root.
        const vec3 tip = i % 4 == 0 ? -3.0f * blade.up + 5e-4f * dice.direction()
                                    : dice.direction() * dice.number(0.0f, 3.0f);
        const Pose pose = poseBlade(blade.up, physicsFront(blade), tip);
        ASSERT_GE(dot(pose.v2, blade.up), -1e-6f);
        ASSERT_GE(dot(pose.v1, blade.up), 0.0f);
    }
}

TEST(Pose, ValidatedTwiceIsTheSame)
{
    tests::Dice dice(3);
    for (int i = 0; i < 100'000; ++i) {
        const Blade blade = physicsBlade(dice);
        const vec3 front = physicsFront(blade);
        const Pose once = poseBlade(blade.up, front, dice.direction() * dice.number(0.1f, 3.0f));
        const Pose twice = poseBlade(blade.up, front, once.v2);
        ASSERT_LT(length(once.v1 - twice.v1), 2e-5f);
        ASSERT_LT(length(once.v2 - twice.v2), 2e-5f);
    }
}

TEST(Pose, IsDefinedForATipOnTheRoot)
{
    const vec3 up(0, 1, 0);
    const vec3 front(1, 0, 0);
    for (const vec3 tip : {vec3(0.0f), vec3(0, -5, 0), vec3(1e-9f, 0, 0)}) {
        const Pose pose = poseBlade(up, front, tip);
        EXPECT_NEAR(dot(pose.v2, up), 0.0f, 1e-6f);
        EXPECT_GT(dot(pose.v2, front), 0.9f);
    }
}

TEST(Physics, WithoutForceNothingMoves)
{
    tests::Dice dice(4);
    for (int i = 0; i < 2000; ++i) {
        const Blade blade = physicsBlade(dice);
        BladeState state = BladeState{0, 0.0f};
        for (int frame = 0; frame < 10; ++frame)
            ASSERT_LE(
                displacementAfter(blade, state, downward(0.0f), still(), float(frame), 0.016f),
                turnMaxError * 4.0f);
    }
}

TEST(Physics, StiffnessOneDoesNotMove)
{
    tests::Dice dice(5);
    for (int i = 0; i < 2000; ++i) {
        Blade blade = physicsBlade(dice);
        blade.stiffness = 1.0f;
        BladeState state = BladeState{0, 0.0f};
        for (int frame = 0; frame < 10; ++frame)
            ASSERT_LE(
                displacementAfter(blade, state, downward(5.0f), someWind(5.0f), float(frame), 0.1f),
                turnMaxError * 4.0f);
    }
}

TEST(Physics, ABentBladeRisesAgainAndNeverSwingsBeyond)
{
    tests::Dice dice(6);
    for (int i = 0; i < 2000; ++i) {
        const Blade blade = physicsBlade(dice);
        BladeState state = stateTowards(blade, dice.direction(), 0.0f);
        // Energy does not grow: without forces the tip's distance from rest never increases.
        float last = fromRest(blade, state);
        for (int frame = 0; frame < 120; ++frame) {
            const float now = displacementAfter(blade, state, downward(0.0f), still(),
                                                float(frame) / 60.0f, 1.0f / 60.0f);
            ASSERT_LE(now, last + 2e-4f) << "frame " << frame;
            last = now;
        }
        ASSERT_LT(last, 0.02f);
    }
}

TEST(Physics, CollisionStrengthSoftensRecoveryAndFades)
{
    tests::Dice dice(7);
    const Blade blade = physicsBlade(dice);
    BladeState trampled = stateTowards(blade, physicsFront(blade), 1.0f);
    BladeState free = stateTowards(blade, physicsFront(blade), 0.0f);
    const float slow = displacementAfter(blade, trampled, downward(0.0f), still(), 0.1f, 0.1f);
    const float quick = displacementAfter(blade, free, downward(0.0f), still(), 0.1f, 0.1f);
    EXPECT_GT(slow, quick + 0.1f);
    EXPECT_LT(trampled.eta, 1.0f);
    displacementAfter(blade, trampled, downward(0.0f), still(), 100.0f, 99.9f);
    EXPECT_EQ(trampled.eta, 0.0f);
}

TEST(Physics, AnyFrameTimeIsSafe)
{
    tests::Dice dice(8);
    for (const float dt : {0.0f, 1e-6f, 1.0f / 240.0f, 1.0f / 10.0f, 2.0f, 60.0f, 1e5f}) {
        for (int i = 0; i < 500; ++i) {
            const Blade blade = physicsBlade(dice);
            BladeState state = stateTowards(blade, dice.direction(), dice.number(0, 1));
            for (int frame = 1; frame <= 5; ++frame) {
                state =
                    advanced(blade, state, downward(8.0f), someWind(20.0f), dt * float(frame), dt);
                const Pose pose = poseOfState(axesTowards(blade.up, physicsFront(blade)), state);
                ASSERT_TRUE(std::isfinite(pose.v2.x + pose.v2.y + pose.v2.z + state.eta));
                ASSERT_GE(dot(pose.v2, blade.up), -1e-4f) << "dt " << dt;
                ASSERT_LE(length(pose.v2), 1.001f) << "dt " << dt;
            }
        }
    }
}

TEST(Physics, OneLongFrameEndsWhereManyShortOnesDo)
{
    tests::Dice dice(9);
    double squared = 0.0;
    constexpr int blades = 500;
    for (int i = 0; i < blades; ++i) {
        const Blade blade = physicsBlade(dice);
        BladeState fine = BladeState{0, 0.0f};
        BladeState coarse = fine;
        for (int frame = 1; frame <= 1200; ++frame)
            fine = advanced(blade, fine, downward(2.0f), someWind(2.0f), float(frame) / 600.0f,
                            1.0f / 600.0f);
        for (int frame = 1; frame <= 60; ++frame)
            coarse = advanced(blade, coarse, downward(2.0f), someWind(2.0f), float(frame) / 30.0f,
                              1.0f / 30.0f);
        const vec3 front = physicsFront(blade);
        const vec3 difference = poseOfState(axesTowards(blade.up, front), fine).v2 -
                                poseOfState(axesTowards(blade.up, front), coarse).v2;
        squared += double(dot(difference, difference));
    }
    EXPECT_LT(std::sqrt(squared / blades), 0.01) << "root mean square, in heights";
}

TEST(Physics, TurnsWithTheWorld)
{
    // No direction is special: turning blade, gravity and wind turns the motion.
    tests::Dice dice(10);
    for (int i = 0; i < 1000; ++i) {
        Blade blade = physicsBlade(dice);
        const vec3 front = physicsFront(blade);
        const vec3 tip = poseBlade(blade.up, front, dice.direction()).v2;
        const vec3 wind = dice.direction() * 2.0f;
        const Gravity gravity{dice.direction(), 2.0f, vec3(0.0f), 0.0f, forwardShare};
        const vec3 moved = relaxTip(blade, front, gravity, wind, physicsRecovery, tip, 0.2f, 0.05f);
        // A cyclic exchange of the axes is a rotation.
        const auto turn = [](vec3 v) { return vec3(v.z, v.x, v.y); };
        Blade turned = blade;
        turned.up = turn(blade.up);
        turned.root = turn(blade.root);
        Gravity turnedGravity = gravity;
        turnedGravity.direction = turn(gravity.direction);
        const vec3 expected = relaxTip(turned, turn(front), turnedGravity, turn(wind),
                                       physicsRecovery, turn(tip), 0.2f, 0.05f);
        ASSERT_LT(length(turn(moved) - expected), 1e-5f);
    }
}

TEST(Physics, TwoStepsAreOne)
{
    // With constant forces and kept length, the division of time does not matter.
    tests::Dice dice(12);
    for (int i = 0; i < 20'000; ++i) {
        const Blade blade = physicsBlade(dice);
        const vec3 front = physicsFront(blade);
        const Gravity gravity{dice.direction(), 3.0f, vec3(0.0f), 0.0f, forwardShare};
        const auto step = [&](vec3 tip, float dt) {
            return relaxTip(blade, front, gravity, vec3(0.0f), physicsRecovery, tip, 0.0f, dt);
        };
        const vec3 tip = normalize(blade.up + 0.8f * dice.direction());
        const float dt = dice.number(0.0f, 0.5f);
        const vec3 once = step(tip, dt);
        const vec3 first = step(tip, 0.3f * dt);
        // Exclude blades that touch the ground in between.
        if (dot(first, blade.up) < 2e-3f || dot(once, blade.up) < 2e-3f)
            continue;
        ASSERT_NEAR(length(once), 1.0f, 1e-5f);
        ASSERT_LT(length(step(first, 0.7f * dt) - once), 2e-5f) << "blade " << i;
    }
}

/// Angle between two directions, which need not be exactly unit.
double angleBetween(vec3 a, vec3 b)
{
    const glm::dvec3 x = glm::normalize(glm::dvec3(a));
    const glm::dvec3 y = glm::normalize(glm::dvec3(b));
    return 2.0 * std::atan2(glm::length(x - y), glm::length(x + y));
}

TEST(Physics, TurnsTowardsItsTargetUntilAShareOfTheTangentIsLeft)
{
    tests::Dice dice(13);
    int below = 0;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 start = dice.direction();
        const vec3 direction(start.x, start.y, std::abs(start.z));
        const float stiffness = dice.number(0, 1);
        const float radius = dice.number(0.9f, 1.0f);
        const float dt = dice.number(0.0f, 0.2f);
        const vec3 force = dice.number(0, 20) * dice.direction();
        const TurnQuotient quotient = relaxTurn(stiffness, force, physicsRecovery,
                                                turnTowards(direction), false, radius, 0.0f, dt);
        const vec3 turned = directionOfQuotient(quotient);

        // By the formula as it is stated, with angles.
        const float b = 1.0f - stiffness;
        const float k = physicsRecovery * (1.0f - 0.25f * b);
        const vec3 place = vec3(0, 0, 1) + (b / k) * force;
        const double before = angleBetween(direction, place);
        const double left =
            std::tan(0.5 * before) * std::exp(-double(k * length(place) / radius * dt));
        const double after = angleBetween(turned, place);
        ASSERT_NEAR(length(turned), 1.0f, 1e-5f);
        ASSERT_NEAR(after, 2.0 * std::atan(left), 2e-5 * (1.0 + before)) << "blade " << i;
        // In the plane of both.
        ASSERT_NEAR(angleBetween(direction, turned), before - after, 1e-4) << "blade " << i;
        // The stored direction equals it, or its contact with the ground.
        const vec3 kept = directionOfTurn(turnAbove(quotient));
        below += turned.z < 0.0f ? 1 : 0;
        ASSERT_LT(length(kept - keptAbove(vec3(0, 0, 1), vec3(1, 0, 0), turned)), 1e-4f);
    }
    EXPECT_GT(below, 500);
}

TEST(Physics, FallsWhereItLeansWhenItIsPulledStraightDown)
{
    for (const float lean : {1e-3f, 0.2f, 0.9f}) {
        const vec2 turn = lean * vec2(0.6f, -0.8f);
        const auto turned = [&](float dt) {
            return turnAbove(
                relaxTurn(0.0f, vec3(0, 0, -20), physicsRecovery, turn, false, 1.0f, 0.0f, dt));
        };
        const vec2 soon = turned(0.01f);
        ASSERT_GT(length(soon), lean * 1.05f);
        ASSERT_LT(length(normalize(soon) - vec2(0.6f, -0.8f)), 1e-5f);
        ASSERT_LT(length(turned(0.5f) - vec2(0.6f, -0.8f)), 1e-5f);
    }
    // An upright blade has no direction and stays; one right below its root lies down forward.
    EXPECT_EQ(turnAbove(relaxTurn(0.0f, vec3(0, 0, -20), physicsRecovery, vec2(0.0f), false, 1.0f,
                                  0.0f, 0.1f)),
              vec2(0.0f));
    EXPECT_EQ(turnAbove(TurnQuotient{vec2(1, 1), vec2(0, 0)}), vec2(1, 0));
}

TEST(Gravity, OfAnAttractorPullsToItFromEverywhere)
{
    const Gravity gravity{vec3(0, -1, 0), 3.0f, vec3(1, 2, 3), 1.0f, forwardShare};
    tests::Dice dice(11);
    for (int i = 0; i < 1000; ++i) {
        const vec3 root = gravity.attractor + dice.direction() * dice.number(0.5f, 20.0f);
        const vec3 pull = gravityAt(gravity, root, vec3(0.0f));
        ASSERT_NEAR(length(pull), 3.0f, 1e-4f);
        ASSERT_NEAR(dot(normalize(pull), normalize(gravity.attractor - root)), 1.0f, 1e-5f);
    }
    EXPECT_EQ(gravityAt(gravity, gravity.attractor, vec3(1, 0, 0)), vec3(0.0f));
}

TEST(Gravity, BlendsDirectionAndAttractor)
{
    const vec3 root(10, 0, 0);
    for (const float blend : {0.0f, 0.25f, 0.5f, 1.0f}) {
        const Gravity gravity{vec3(0, -1, 0), 2.0f, vec3(0.0f), blend, 0.0f};
        const vec3 expected = 2.0f * ((1.0f - blend) * vec3(0, -1, 0) + blend * vec3(-1, 0, 0));
        ASSERT_LT(length(gravityAt(gravity, root, vec3(0, 0, 1)) - expected), 1e-6f);
    }
}

TEST(Gravity, LeansForwardByAQuarterOfItsPull)
{
    const vec3 front(0, 0, 1);
    const vec3 pull = gravityAt(downward(4.0f), vec3(0.0f), front);
    EXPECT_EQ(pull, vec3(0, -4, 1));
}

} // namespace
} // namespace sward::shared
