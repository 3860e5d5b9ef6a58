// How a blade moves: Jahrmann & Wimmer, "Responsive Real-Time Grass Rendering for General 3D
// Scenes", I3D 2017, section 5, in units of the blade's own height and relative to its root.
#ifndef SWARD_SHARED_PHYSICS_H
#define SWARD_SHARED_PHYSICS_H

#include "shaders/shared/bezier.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/collision.h"
#include "shaders/shared/types.h"
#include "shaders/shared/wind.h"

SHARED_BEGIN

/// What moves between frames. A pose is a function of the tip's direction alone, so that this is
/// all that is stored of it: 4 bytes; and where there are colliders 4 more.
struct BladeState {
    uint turn; ///< snorm16 × 2: towards the blade's front and to its side, each the tangent of half
               ///< the angle between the up-vector and the tip's direction; 0: straight up
    float eta; ///< [0, 1] strength of the last collision
};

/// The pull of gravity: a direction, an attractor, or a blend of both.
struct Gravity {
    vec3 direction; ///< unit
    float strength; ///< [1/s] in heights per second
    vec3 attractor; ///< [m] relative to the field's origin: a planet's centre
    float blend;    ///< [0, 1]: 0 direction only, 1 attractor only
    float
        forward; ///< [0, 1] share of the pull that leans a blade forward; the paper's is a quarter
};
SHARED_LAYOUT(Gravity, 36)

/// Gravity::forward of the paper.
SHARED_CONST float forwardShare = 0.25f;

/// A blade's control points relative to its root, in heights; v0 is the origin.
struct Pose {
    vec3 v1;
    vec3 v2;
};

/// Half of a step of a stored tangent, and the rounding of a number near 1. The direction turns by
/// twice that at most along each axis [rad].
SHARED_CONST float turnMaxError = 1.54e-5f;

/// The state of a blade whose tip is seen from its root in `direction`, unit and not below the
/// blade's ground plane: stereographic, so that no direction is stored worse than half as well as
/// another. `front` is unit and at right angles to `up`.
SHARED_FN BladeState stateOf(vec3 up, vec3 front, vec3 direction, float eta)
{
    const float share = 1.0f / (1.0f + max(dot(direction, up), 0.0f));
    BladeState state;
    state.turn = packSnorm16(share * dot(direction, front)) |
                 (packSnorm16(share * dot(direction, cross(up, front))) << 16u);
    state.eta = eta;
    return state;
}

/// Where the tip points: never below the ground plane, and unit, but for one that lies in it, which
/// may be longer by √2·turnMaxError.
SHARED_FN vec3 directionOf(vec3 up, vec3 front, BladeState state)
{
    const float forward = unpackSnorm16(state.turn);
    const float aside = unpackSnorm16(state.turn >> 16u);
    const float square = min(forward * forward + aside * aside, 1.0f);
    return (1.0f / (1.0f + square)) *
           (2.0f * (forward * front + aside * cross(up, front)) + (1.0f - square) * up);
}

/// Gravity at `root` [m] with its elastic forward part: g = gE + forward·‖gE‖·front
/// (section 5.1).
SHARED_FN vec3 gravityAt(Gravity gravity, vec3 root, vec3 front)
{
    vec3 towards = gravity.direction;
    if (gravity.blend > 0.0f) {
        const vec3 toAttractor = gravity.attractor - root;
        const float distance = length(toAttractor);
        const vec3 pull = distance > 1e-6f ? toAttractor / distance : vec3(0.0f);
        towards = mix(gravity.direction, pull, gravity.blend);
    }
    const vec3 environment = gravity.strength * towards;
    return environment + gravity.forward * length(environment) * front;
}

/// What a curve from the root over v1 = up · max(1 − side, 0.05) to a tip at unit distance, `side`
/// from the up-vector's line, is to be multiplied by to be one height long: polynomials fitted to
/// the exact length, within 2.1e-4; 1 where it is straight (the paper's estimate after Gravesen,
/// (2·|v2−v0| + |v1−v0| + |v2−v1|)/3, is within 1.1e-2). Asserted by bezier_test.cpp.
SHARED_FN float lengthCorrection(float side)
{
    if (side > 0.95f)
        return (-0.48620368f * side + 0.92399928f) * side + 0.55642926f;
    const float high = (-1.3481541f * side + 4.0007265f) * side - 4.6675167f;
    const float low = (high * side + 2.7635532f) * side - 0.71043977f;
    return (low * side - 0.037761414f) * side + 1.0f;
}

/// How far from its root [heights] a blade's tip is seen in `direction`, as poseTowards() has it.
SHARED_FN float tipDistance(vec3 up, vec3 direction)
{
    return lengthCorrection(length(direction - up * dot(direction, up)));
}

/// Steps 2 and 3 of poseBlade(), of a tip in `direction`, unit and not below the ground plane.
SHARED_FN Pose poseTowards(vec3 up, vec3 direction)
{
    const float side = length(direction - up * dot(direction, up));
    const vec3 v1 = up * max(1.0f - side, 0.05f);
    const float scale = lengthCorrection(side);
    Pose pose;
    pose.v1 = v1 * scale;
    pose.v2 = direction * scale;
    return pose;
}

/// `direction`, which is unit, lifted to the ground plane if it points below it.
SHARED_FN vec3 keptAbove(vec3 up, vec3 front, vec3 direction)
{
    const float rise = dot(up, direction);
    if (rise >= 0.0f)
        return direction;
    const vec3 lifted = direction - up * rise;
    // A tip on the root has no direction: let the blade lie down forward.
    const float distance = length(lifted);
    const vec3 towards = distance > 1e-4f ? lifted / distance : front;
    // Division has magnified the rounding of the first step: lift again.
    return towards - up * min(dot(up, towards), 0.0f);
}

/// The three validation steps (section 5.3) for a tip at `tip` heights from the root:
///   1. the tip is lifted to the blade's ground plane;
///   2. v1 = up · max(1 − l, 0.05), l the tip's distance from the up-vector's line: always slightly
///   curved;
///   3. both are scaled about the root until the curve is one height long.
/// The paper applies 2 and 3 to whatever length the tip has, so that each frame's result differs
/// from its own validation. Here the tip is brought to unit distance first: the pose is a function
/// of the tip's direction alone, and validating twice changes nothing.
SHARED_FN Pose poseBlade(vec3 up, vec3 front, vec3 tip)
{
    const vec3 lifted = tip - up * min(dot(up, tip), 0.0f);
    const float distance = length(lifted);
    return poseTowards(up, keptAbove(up, front, distance > 1e-4f ? lifted / distance : front));
}

/// The pose that a stored state stands for.
SHARED_FN Pose poseOfState(vec3 up, vec3 front, BladeState state)
{
    return poseTowards(up, directionOf(up, front, state));
}

/// One step of `dt` [s] (section 5.2) of a tip that is seen in `direction`, unit, `radius` heights
/// from its root: tip' = recovery + gravity + wind, with the length kept, solved exactly for forces
/// that stand still. Without the length the tip would relax towards rest + (g + w)/k with rate k;
/// on the ball of all tips it turns towards the direction of that place, and the tangent of half
/// the angle between them falls with rate k·|place|/|tip|. So any step is safe, and the frame rate
/// does not matter. A blade that lies turns along the ground alone. Returns a direction, unit, for
/// keptAbove(). With b = 1 − stiffness, as in the authors' demo, gravity and wind count b and
/// recovery 1 − b/4; collision strength eta softens recovery. `force` is what gravityAt() and
/// windForce() return, together.
SHARED_FN vec3 relaxDirection(Blade blade, vec3 force, float recovery, vec3 direction, float radius,
                              float eta, float dt)
{
    const float b = 1.0f - blade.stiffness;
    const float k = max(recovery * (1.0f - 0.25f * b) * max(1.0f - eta, 0.1f), 1e-3f);
    vec3 place = blade.up + (b / k) * force;
    const float sink = dot(place, blade.up);
    if (sink < 0.0f && dot(direction, blade.up) < 1e-3f)
        place -= sink * blade.up;
    const float square = dot(place, place);
    if (square < 1e-12f)
        return direction;
    const float inverse = inversesqrt(square);
    const vec3 target = place * inverse;

    // With t the tangent of half the angle: cos = (1 − t²)/(1 + t²), sin = 2t/(1 + t²).
    const float cosine = clamp(dot(direction, target), -1.0f, 1.0f);
    const float fall = exp(-k * (square * inverse) / radius * dt);
    const float near = 1.0f + cosine;
    const float far = (1.0f - cosine) * fall * fall;
    // Straight away from the target nothing turns it to any side.
    if (near + far < 1e-6f)
        return direction;
    return normalize((near - far) * target + 2.0f * fall * (direction - cosine * target));
}

/// The same of a valid `tip` [heights], whose forces are given one by one.
SHARED_FN vec3 relaxTip(Blade blade, vec3 front, Gravity gravity, vec3 wind, float recovery,
                        vec3 tip, float eta, float dt)
{
    const float radius = max(length(tip), 1e-6f);
    return relaxDirection(blade, gravityAt(gravity, blade.root, front) + wind, recovery,
                          tip / radius, radius, eta, dt);
}

/// Rounds of pushing a blade out of all colliders near it. One collider takes one or two; between
/// several a blade finds its place in some frames.
SHARED_CONST uint contactRounds = 3u;

/// How much farther than the curve's middle the tip is pushed. The paper has 4, as if only v2
/// moved; v1 goes with it, so that the middle moves by a quarter to a half of the tip's way, and 4
/// overshoots: some blades between two colliders then jump to and fro.
SHARED_CONST float middleLever = 2.0f;

/// The tip of a valid blade, `tipBefore` one step ago, after all colliders near it, as they were
/// `back` [s] ago, have pushed it out at the tip and at the curve's middle, validated after each
/// push. `pushed` grows by what the tip was moved [heights]; `resting` turns false where a collider
/// that moves touches. Colliders that still disagree after all rounds, and rest, move it half of
/// the way: else it could go to and fro between them for ever.
SHARED_FN vec3 pushBlade(Blade blade, vec3 front, ColliderTable colliders, ColliderMask near,
                         vec3 tipBefore, vec3 tip, float back, SHARED_INOUT(float) pushed,
                         SHARED_INOUT(bool) resting)
{
    Pose pose = poseBlade(blade.up, front, tip);
    vec3 result = tip;
    bool touched = true;
    for (uint turn = 0u; turn < contactRounds && touched; ++turn) {
        touched = false;
        for (uint word = 0u; word < colliderWords; ++word) {
            for (uint bits = near.words[word]; bits != 0u; bits &= bits - 1u) {
                const Collider collider = colliderSeenFrom(
                    colliders.at[32u * word + uint(findLSB(bits))], blade.root, blade.height, back);
                // Out of reach.
                if (length(towardsSegment(collider, vec3(0.0f))) >= collider.radius + 1.0f)
                    continue;
                for (uint point = 0u; point < 2u; ++point) {
                    const vec3 middle = 0.5f * pose.v1 + 0.25f * pose.v2;
                    const vec3 push = point == 0u ? pushOut(collider, pose.v2, front)
                                                  : middleLever * pushOut(collider, middle, front);
                    if (dot(push, push) > 0.0f) {
                        const vec3 before = pose.v2;
                        pose = poseBlade(blade.up, front, before + push);
                        result = pose.v2;
                        pushed += length(result - before);
                        resting = resting && dot(collider.velocity, collider.velocity) == 0.0f;
                        touched = true;
                    }
                }
            }
        }
    }
    return touched && resting ? poseBlade(blade.up, front, tipBefore + result).v2 : result;
}

/// What moves every blade of a field in one frame.
struct Nature {
    Gravity gravity;
    float recovery;     ///< [1/s] rate at which a stiff blade rises again
    uint colliderCount; ///< 0: no blade asks for colliders
    uint reserved;
    Wind wind;
    ColliderTable colliders;
};
SHARED_LAYOUT(Nature, 80)

/// Longest time the forces are taken to stand still [s], and how often at most one frame is
/// divided.
SHARED_CONST float longestStep = 0.034f;
SHARED_CONST uint maxSteps = 16u;

/// Between colliders at rest a blade sticks: slower than this [heights per second] it does not move
/// at all. Without it blades between two overlapping colliders would tremble for ever.
SHARED_CONST float stickingSpeed = 0.06f;

/// Moves a blade by the time `elapsed` [s] up to `time`, however long. `near` are the colliders
/// that may touch it. Returns its new state.
SHARED_FN BladeState advanceBlade(Blade blade, Nature nature, ColliderMask near, BladeState state,
                                  float time, float elapsed)
{
    const vec3 front = frontOf(blade.up, widthAxis(blade.up, blade.facing));
    // Contact fades within 1/a seconds, a = (1 − b)/2 … 1/2 as in the demo.
    const float fade = 0.5f * max(blade.stiffness, 0.1f);
    const uint steps = uint(clamp(ceil(elapsed / longestStep), 1.0f, float(maxSteps)));
    const float dt = elapsed / float(steps);

    const vec3 gravity = gravityAt(nature.gravity, blade.root, front);
    const vec3 first = directionOf(blade.up, front, state);
    vec3 direction = first;
    float eta = state.eta;
    float pushed = 0.0f;
    bool resting = true;
    for (uint i = 0u; i < steps; ++i) {
        const float back = elapsed - dt * float(i + 1u);
        eta = max(eta - fade * dt, 0.0f);
        // The wind of the middle of the step stands for all of it.
        const float radius = tipDistance(blade.up, direction);
        const vec3 tipBefore = radius * direction;
        const vec3 wind =
            windForce(nature.wind, blade.root, blade.up, tipBefore, time - back - 0.5f * dt);
        direction =
            relaxDirection(blade, gravity + wind, nature.recovery, direction, radius, eta, dt);
        direction = keptAbove(blade.up, front, direction);
        if (nature.colliderCount > 0u) {
            const float before = pushed;
            const vec3 tip =
                pushBlade(blade, front, nature.colliders, near, tipBefore,
                          tipDistance(blade.up, direction) * direction, back, pushed, resting);
            direction = normalize(tip);
            eta = min(eta + (pushed - before), 1.0f);
        }
    }
    if (pushed > 0.0f && resting &&
        length(tipDistance(blade.up, direction) * direction -
               tipDistance(blade.up, first) * first) < stickingSpeed * elapsed)
        return state;
    return stateOf(blade.up, front, direction, eta);
}

SHARED_END
#endif
