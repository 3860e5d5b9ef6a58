#include "shaders/shared/collision.h"
#include "shaders/shared/physics.h"
#include "unit/shared/random_vectors.h"
#include "unit/shared/winds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

constexpr float collisionRecovery = 6.0f;
constexpr Gravity collisionGravity{vec3(0, -1, 0), 6.5f, vec3(0.0f), 0.0f, forwardShare};

Collider sphere(vec3 centre, float radius)
{
    return {centre, radius, centre, 0, vec3(0.0f), 0};
}

Blade bladeAt(tests::Dice& dice, vec3 root)
{
    Blade blade = {};
    blade.root = root;
    blade.up = normalize(vec3(0, 1, 0) + 0.2f * dice.direction());
    blade.facing = dice.number(0.0f, twoPi);
    blade.stiffness = dice.number(0.2f, 0.9f);
    blade.height = dice.number(0.2f, 0.8f);
    return blade;
}

vec3 collisionFront(const Blade& blade)
{
    return frontOf(blade.up, widthAxis(blade.up, blade.facing));
}

/// Relative to the root, in heights.
vec3 tipOf(const Blade& blade, const BladeState& state)
{
    return poseOfState(axesTowards(blade.up, collisionFront(blade)), state).v2;
}

/// Moves a blade frame by frame of 1/60 s.
BladeState after(int frames, const Blade& blade, BladeState state,
                 const tests::EnvironmentTables& tables)
{
    for (int frame = 1; frame <= frames; ++frame)
        state = advanceBlade(blade, tables.environment(collisionGravity, collisionRecovery),
                             tables.everyCollider(), state, float(frame) / 60.0f, 1.0f / 60.0f);
    return state;
}

/// Depth of tip or middle inside a collider, in heights.
float depthOf(const Blade& blade, const BladeState& state, const Collider& collider)
{
    const Collider seen = colliderSeenFrom(collider, blade.root, blade.height, 0.0f);
    const vec3 front = collisionFront(blade);
    const Pose pose = poseOfState(axesTowards(blade.up, front), state);
    return std::max(length(pushOut(seen, pose.v2, front)),
                    length(pushOut(seen, 0.5f * pose.v1 + 0.25f * pose.v2, front)));
}

TEST(Collider, PushesAPointOntoItsSurface)
{
    tests::Dice dice(1);
    for (int i = 0; i < 20'000; ++i) {
        Collider capsule = sphere(dice.direction(), dice.number(0.1f, 1.0f));
        if (i % 2 == 0)
            capsule.to += 2.0f * dice.direction();
        const vec3 point = dice.direction() * dice.number(0.0f, 3.0f);
        const vec3 push = pushOut(capsule, point, vec3(0, 1, 0));
        const float before = length(towardsSegment(capsule, point));
        const float now = length(towardsSegment(capsule, point + push));
        ASSERT_NEAR(now, std::max(before, capsule.radius), 2e-5f);
        if (before >= capsule.radius) {
            ASSERT_EQ(push, vec3(0.0f));
        }
    }
    // On the segment itself, only the fallback direction is defined.
    EXPECT_EQ(pushOut(sphere(vec3(0.0f), 2.0f), vec3(0.0f), vec3(0, 0, 1)), vec3(0, 0, 2));
}

TEST(Collider, IsNearEveryBoxThatItTouchesOnItsWay)
{
    tests::Dice dice(2);
    int near = 0;
    for (int i = 0; i < 50'000; ++i) {
        Collider collider = sphere(4.0f * dice.direction(), dice.number(0.05f, 0.5f));
        collider.to += dice.direction();
        collider.velocity = 5.0f * dice.direction();
        const vec3 low = 3.0f * dice.direction();
        const vec3 high = low + vec3(dice.number(0, 2), dice.number(0, 2), dice.number(0, 2));
        const float elapsed = dice.number(0.0f, 0.5f);
        const bool isNear = colliderNear(collider, low, high, elapsed);
        near += isNear ? 1 : 0;
        const vec3 point =
            mix(low, high, vec3(dice.number(0, 1), dice.number(0, 1), dice.number(0, 1)));
        const Collider then =
            colliderSeenFrom(collider, vec3(0.0f), 1.0f, dice.number(0.0f, elapsed));
        if (length(towardsSegment(then, point)) < collider.radius) {
            ASSERT_TRUE(isNear);
        }
    }
    EXPECT_LT(near, 25'000) << "or nothing is culled at all";
}

TEST(Collision, PressesABladeDownAndItRisesAgain)
{
    tests::Dice dice(3);
    int pressed = 0;
    for (int i = 0; i < 300; ++i) {
        const Collider ball = sphere(vec3(0.0f, 0.35f, 0.0f), 0.3f);
        const tests::EnvironmentTables free;
        const tests::EnvironmentTables under({}, {ball});
        Blade blade = bladeAt(dice, vec3(dice.number(-0.5f, 0.5f), 0, dice.number(-0.5f, 0.5f)));
        // Softer blades may stay on the other side.
        blade.stiffness = dice.number(0.5f, 0.9f);

        const BladeState rest = after(300, blade, BladeState{0, 0.0f}, free);
        const BladeState hit = after(1, blade, rest, under);
        const BladeState down = after(60, blade, hit, under);
        ASSERT_LT(depthOf(blade, down, ball), 0.02f) << "blade " << i;
        if (depthOf(blade, rest, ball) < 0.02f)
            continue;
        ++pressed;
        ASSERT_GT(hit.eta, 0.005f);
        ASSERT_GT(length(tipOf(blade, down) - tipOf(blade, rest)), 0.005f);

        // Without the sphere it returns completely, and the contact's strength has decayed.
        const BladeState soon = after(30, blade, down, free);
        const BladeState late = after(2400, blade, down, free);
        ASSERT_LE(soon.eta, down.eta);
        ASSERT_EQ(late.eta, 0.0f);
        ASSERT_LT(length(tipOf(blade, late) - tipOf(blade, rest)), 0.02f) << "blade " << i;
    }
    EXPECT_GT(pressed, 50);
}

TEST(Collision, LeavesABladeOutOfReachAlone)
{
    tests::Dice dice(4);
    const tests::EnvironmentTables far({}, {sphere(vec3(2.0f, 0.0f, 0.0f), 0.5f)});
    const tests::EnvironmentTables none;
    for (int i = 0; i < 200; ++i) {
        const Blade blade = bladeAt(dice, vec3(dice.number(-0.5f, 0.4f), 0, 0));
        const BladeState with = after(20, blade, BladeState{0, 0.0f}, far);
        const BladeState without = after(20, blade, BladeState{0, 0.0f}, none);
        ASSERT_EQ(with.turn, without.turn);
        ASSERT_EQ(with.eta, without.eta);
    }
}

TEST(Collision, BetweenOverlappingCollidersAtRestNothingTrembles)
{
    // A ball in a ball, and a capsule lying through both.
    tests::Dice dice(5);
    Collider log = sphere(vec3(0.2f, 0.1f, -0.6f), 0.25f);
    log.to = vec3(0.2f, 0.15f, 0.7f);
    const tests::EnvironmentTables tables(
        {}, {sphere(vec3(0.0f, 0.25f, 0.0f), 0.4f), sphere(vec3(0.4f, 0.2f, 0.1f), 0.35f), log});
    int touched = 0;
    for (int i = 0; i < 200; ++i) {
        const Blade blade =
            bladeAt(dice, vec3(dice.number(-0.5f, 0.9f), 0, dice.number(-0.7f, 0.7f)));
        BladeState state = after(2700, blade, BladeState{0, 0.0f}, tables);
        touched += state.eta > 0.0f ? 1 : 0;
        for (int frame = 0; frame < 30; ++frame) {
            const BladeState next = after(1, blade, state, tables);
            ASSERT_EQ(next.turn, state.turn) << "blade " << i << ", frame " << frame;
            state = next;
        }
    }
    EXPECT_GT(touched, 60);
}

TEST(Collision, MeetsABladeBetweenTwoFrames)
{
    // At 6 m/s and 10 frames per second the sphere skips the blade's position between frames.
    tests::Dice dice(6);
    Collider ball = sphere(vec3(0.3f, 0.3f, 0.0f), 0.2f);
    ball.velocity = vec3(6, 0, 0);
    const tests::EnvironmentTables tables({}, {ball});
    Blade blade = bladeAt(dice, vec3(0.0f));
    blade.up = vec3(0, 1, 0);
    blade.height = 0.5f;
    const BladeState state =
        advanceBlade(blade, tables.environment(collisionGravity, collisionRecovery),
                     tables.everyCollider(), BladeState{0, 0.0f}, 0.1f, 0.1f);
    EXPECT_GT(state.eta, 0.05f);
}

TEST(Collision, AnyFrameTimeIsSafe)
{
    tests::Dice dice(7);
    for (const float dt : {1e-6f, 1.0f / 240.0f, 0.1f, 2.0f, 60.0f, 1e5f}) {
        for (int i = 0; i < 300; ++i) {
            // Balls of any size anywhere, one around the root among them.
            Collider ball =
                sphere(dice.direction() * dice.number(0.0f, 0.6f), dice.number(0.01f, 1.0f));
            ball.velocity = dice.direction() * dice.number(0.0f, 3.0f);
            const tests::EnvironmentTables tables({tests::windSourceOf(windNoise, 8.0f)},
                                                  {ball, sphere(vec3(0.0f), 0.3f)});
            const Blade blade = bladeAt(dice, vec3(0.0f));
            const vec3 front = collisionFront(blade);
            const vec3 tip = poseBlade(blade.up, front, dice.direction()).v2;
            BladeState state = stateOf(blade.up, front, normalize(tip), dice.number(0, 1));
            for (int frame = 1; frame <= 4; ++frame) {
                state = advanceBlade(blade, tables.environment(collisionGravity, collisionRecovery),
                                     tables.everyCollider(), state, dt * float(frame), dt);
                const vec3 now = tipOf(blade, state);
                ASSERT_TRUE(std::isfinite(now.x + now.y + now.z + state.eta));
                ASSERT_GE(dot(now, blade.up), -1e-4f);
            }
        }
    }
}

} // namespace
} // namespace sward::shared
