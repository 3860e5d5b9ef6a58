// The pose of a blade: its stored state, and the curve of that state. Jahrmann & Wimmer,
// "Responsive Real-Time Grass Rendering for General 3D Scenes", I3D 2017, section 5.3, in units of
// the blade's own height and relative to its root.
#ifndef SWARD_SHARED_POSE_H
#define SWARD_SHARED_POSE_H

#include "shaders/shared/bezier.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// The state that changes between frames. A pose is a function of the tip's direction alone, so the
/// stored state has 4 bytes, and 4 more with colliders.
struct BladeState {
    uint turn; ///< snorm16 × 2: towards the blade's front and its side, each the tangent of half
               ///< the angle between the up-vector and the tip's direction; 0: straight up
    float eta; ///< [0, 1] strength of the last collision
};

/// BladeState::turn of a blade that has never been moved: packSnorm16() never makes it. Such a blade
/// is settled in its wind before it is drawn.
SHARED_CONST uint unsettledTurn = 0x80008000u;

/// A blade's control points relative to its root, in heights; v0 is the origin.
struct Pose {
    vec3 v1;
    vec3 v2;
};

/// Half a step of a stored tangent, plus the rounding of a number near 1. The direction's error is
/// at most twice that along each axis [rad].
SHARED_CONST float turnMaxError = 1.54e-5f;

/// The turn of a tip in `direction` from its root, along the blade's axes, unit and not below its
/// ground plane. Stereographic: the precision of all directions is equal within a factor of two.
SHARED_FN vec2 turnTowards(vec3 direction)
{
    return (1.0f / (1.0f + max(direction.z, 0.0f))) * vec2(direction.x, direction.y);
}

/// The direction of a tip with this turn. Unit, except that a lying tip's may be longer by
/// √2·turnMaxError.
SHARED_FN vec3 directionOfTurn(vec2 turn)
{
    const float square = min(dot(turn, turn), 1.0f);
    return (1.0f / (1.0f + square)) * vec3(2.0f * turn.x, 2.0f * turn.y, 1.0f - square);
}

/// The state of a blade with this turn.
SHARED_FN BladeState stateOfTurn(vec2 turn, float eta)
{
    BladeState state;
    state.turn = packSnorm16(turn.x) | (packSnorm16(turn.y) << 16u);
    state.eta = eta;
    return state;
}

/// The state of a blade whose tip lies in `direction`, in space. `front` is unit and perpendicular
/// to `up`.
SHARED_FN BladeState stateOf(vec3 up, vec3 front, vec3 direction, float eta)
{
    return stateOfTurn(turnTowards(alongAxes(axesTowards(up, front), direction)), eta);
}

SHARED_FN vec2 storedTurn(BladeState state)
{
    return vec2(unpackSnorm16(state.turn), unpackSnorm16(state.turn >> 16u));
}

/// Direction of the tip, along the blade's axes: never below the ground plane, as from
/// directionOfTurn().
SHARED_FN vec3 storedDirection(BladeState state)
{
    return directionOfTurn(storedTurn(state));
}

/// The same in space.
SHARED_FN vec3 directionOf(vec3 up, vec3 front, BladeState state)
{
    return inSpace(axesTowards(up, front), storedDirection(state));
}

/// Factor that makes a curve one height long. The curve runs from the root over v1 = up · max(1 −
/// side, 0.05) to a tip at unit distance, `side` from the up-vector's line. Polynomials fitted to
/// the exact length, within 2.1e-4; 1 for a straight curve. (The paper's estimate after Gravesen,
/// (2·|v2−v0| + |v1−v0| + |v2−v1|)/3, is within 1.1e-2.) Asserted by bezier_test.cpp.
SHARED_FN float lengthCorrection(float side)
{
    if (side > 0.95f)
        return (-0.48620368f * side + 0.92399928f) * side + 0.55642926f;
    const float high = (-1.3481541f * side + 4.0007265f) * side - 4.6675167f;
    const float low = (high * side + 2.7635532f) * side - 0.71043977f;
    return (low * side - 0.037761414f) * side + 1.0f;
}

/// Distance [heights] from the root of a blade's tip in `direction`, along its axes, as in
/// poseTowards().
SHARED_FN float tipDistance(vec3 direction)
{
    return lengthCorrection(length(vec2(direction.x, direction.y)));
}

/// Steps 2 and 3 of poseBlade(), for a tip in `direction`, unit and not below the ground plane.
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

/// Unit `direction`, lifted to the ground plane if it points below it.
SHARED_FN vec3 keptAbove(vec3 up, vec3 front, vec3 direction)
{
    const float rise = dot(up, direction);
    if (rise >= 0.0f)
        return direction;
    const vec3 lifted = direction - up * rise;
    // A tip on the root has no direction: the blade lies down forward.
    const float distance = length(lifted);
    const vec3 towards = distance > 1e-4f ? lifted / distance : front;
    // The division has magnified the rounding of the first step: lift again.
    return towards - up * min(dot(up, towards), 0.0f);
}

/// The three validation steps (section 5.3) for a tip at `tip` heights from the root:
///   1. the tip is lifted to the blade's ground plane;
///   2. v1 = up · max(1 − l, 0.05), l the tip's distance from the up-vector's line: always slightly
///   curved;
///   3. both are scaled about the root until the curve is one height long.
/// The paper applies 2 and 3 to a tip of any length, so that each frame's result differs from its
/// own validation. Here the tip is brought to unit distance first: the pose is a function of the
/// tip's direction alone, and a second validation changes nothing.
SHARED_FN Pose poseBlade(vec3 up, vec3 front, vec3 tip)
{
    const vec3 lifted = tip - up * min(dot(up, tip), 0.0f);
    const float distance = length(lifted);
    return poseTowards(up, keptAbove(up, front, distance > 1e-4f ? lifted / distance : front));
}

/// The pose of a stored state.
SHARED_FN Pose poseOfState(BladeAxes axes, BladeState state)
{
    const vec3 direction = storedDirection(state);
    const float side = length(vec2(direction.x, direction.y));
    const float scale = lengthCorrection(side);
    Pose pose;
    pose.v1 = axes.up * (max(1.0f - side, 0.05f) * scale);
    pose.v2 = inSpace(axes, direction * scale);
    return pose;
}

SHARED_END
#endif
