// Motion of a blade: Jahrmann & Wimmer, "Responsive Real-Time Grass Rendering for General 3D
// Scenes", I3D 2017, section 5, in units of the blade's own height and relative to its root.
#ifndef SWARD_SHARED_PHYSICS_H
#define SWARD_SHARED_PHYSICS_H

#include "shaders/shared/blade.h"
#include "shaders/shared/collision.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/types.h"
#include "shaders/shared/wind.h"

SHARED_BEGIN

/// Gravity at `root` [m] without its elastic forward part, gE (section 5.1).
SHARED_FN vec3 environmentAt(Gravity gravity, vec3 root)
{
    vec3 towards = gravity.direction;
    if (gravity.blend > 0.0f) {
        const vec3 toAttractor = gravity.attractor - root;
        const float distance = length(toAttractor);
        const vec3 pull = distance > 1e-6f ? toAttractor / distance : vec3(0.0f);
        towards = mix(gravity.direction, pull, gravity.blend);
    }
    return gravity.strength * towards;
}

/// Gravity with that part: g = gE + forward·‖gE‖·front.
SHARED_FN vec3 gravityAt(Gravity gravity, vec3 root, vec3 front)
{
    const vec3 environment = environmentAt(gravity, root);
    return environment + gravity.forward * length(environment) * front;
}

/// A stored turn, see BladeState, as a quotient of two complex numbers: the front is their real
/// axis. So a tip right below its root has a turn, too.
struct TurnQuotient {
    vec2 over;
    vec2 under;
};

/// a times the conjugate of b.
SHARED_FN vec2 timesConjugate(vec2 a, vec2 b)
{
    return vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

/// The turn, moved into the ground plane if the tip lies below it.
SHARED_FN vec2 turnAbove(TurnQuotient turn)
{
    const vec2 product = timesConjugate(turn.over, turn.under);
    const float under = dot(turn.under, turn.under);
    if (dot(turn.over, turn.over) <= under)
        return (1.0f / under) * product;
    const float square = dot(product, product);
    // A tip right below its root has no direction: the blade lies down forward.
    return square > 1e-30f ? inversesqrt(square) * product : vec2(1.0f, 0.0f);
}

/// Unit direction of such a tip along the blade's axes, also below the ground.
SHARED_FN vec3 directionOfQuotient(TurnQuotient turn)
{
    const float over = dot(turn.over, turn.over);
    const float under = dot(turn.under, turn.under);
    const vec2 product = timesConjugate(turn.over, turn.under);
    return (1.0f / (under + over)) * vec3(2.0f * product.x, 2.0f * product.y, under - over);
}

/// A blade is lying if its tip's direction rises at most this much.
SHARED_CONST float lyingBelow = 1e-3f;

/// One step of `dt` [s] (section 5.2) of a tip at `turn`, `radius` heights from its root: tip' =
/// recovery + gravity + wind, with constant length, solved exactly for constant forces. Without the
/// length the tip would relax towards rest + (g + w)/k with rate k. On the sphere of all tips it
/// turns towards the direction of that place; the tangent of half the angle between them falls with
/// rate k·|place|/|tip|. So a step of any size is stable, and the result does not depend on the
/// frame rate. A turn is the tip's place on a plane onto which the sphere is projected; rotations
/// of the sphere are quotients of linear functions there. The quotient combines three steps:
/// rotation of the target to the up-vector, scaling by `fall`, and the inverse rotation. A blade
/// that `lies` turns along the ground only. With b = 1 − stiffness, as in the authors' demo,
/// gravity and wind count b and recovery 1 − b/4; collision strength eta reduces recovery. `force`
/// is gravity plus wind, along the blade's axes.
SHARED_FN TurnQuotient relaxTurn(float stiffness, vec3 force, float recovery, vec2 turn, bool lies,
                                 float radius, float eta, float dt)
{
    const float b = 1.0f - stiffness;
    const float k = max(recovery * (1.0f - 0.25f * b) * max(1.0f - eta, 0.1f), 1e-3f);
    // k times the place.
    vec3 pull = b * force;
    pull.z += k;
    if (lies)
        pull.z = max(pull.z, 0.0f);
    const float strength = length(pull);
    TurnQuotient turned;
    turned.over = turn;
    turned.under = vec2(1.0f, 0.0f);
    // No sideways pull.
    if (strength < 1e-6f * k)
        return turned;
    const float fall = exp(-(strength / radius) * dt);
    const float above = strength + pull.z;
    const float below = strength - pull.z;
    const vec2 towards = (1.0f - fall) * vec2(pull.x, pull.y);
    turned.over = (fall * above + below) * turn + towards;
    turned.under = timesConjugate(turn, towards);
    turned.under.x += above + fall * below;
    return turned;
}

/// The same for a valid `tip` [heights] in space, with separate forces.
SHARED_FN vec3 relaxTip(Blade blade, vec3 front, Gravity gravity, vec3 wind, float recovery,
                        vec3 tip, float eta, float dt)
{
    const BladeAxes axes = axesTowards(blade.up, front);
    const float radius = max(length(tip), 1e-6f);
    const vec3 force = gravityAt(gravity, blade.root, front) + wind;
    const vec3 direction = alongAxes(axes, tip / radius);
    return inSpace(axes, directionOfQuotient(relaxTurn(blade.stiffness, alongAxes(axes, force),
                                                       recovery, turnTowards(direction),
                                                       direction.z < lyingBelow, radius, eta, dt)));
}

/// Iterations of pushing a blade out of all colliders near it. One collider takes one or two;
/// between several a blade converges over some frames.
SHARED_CONST uint contactRounds = 3u;

/// Factor of the tip's push for contacts of the curve's middle. The paper has 4, as if only v2
/// moved. But v1 moves too, so the middle moves by a quarter to a half of the tip's way, and 4
/// overshoots: some blades between two colliders then oscillate.
SHARED_CONST float middleLever = 2.0f;

/// The tip of a valid blade after all colliders near it, as of `back` [s] ago, have pushed it.
/// Pushes apply to the tip and to the curve's middle, with a validation after each. `tipBefore`:
/// one step ago. `pushed` grows by the tip's motion [heights]; `resting` turns false on contact
/// with a moving collider. If resting colliders still push after all iterations, the tip moves half
/// of the way: otherwise it could oscillate between them forever.
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

/// Longest time of constant forces [s], and maximum number of steps per frame.
SHARED_CONST float longestStep = 0.034f;
SHARED_CONST uint maxSteps = 16u;

/// Friction between colliders at rest: a blade slower than this [heights per second] does not move.
/// Otherwise blades between two overlapping colliders would tremble forever.
SHARED_CONST float stickingSpeed = 0.06f;

/// Moves a blade by the time `elapsed` [s] up to `time` [s], counted from the time of the wind's
/// phases, for any duration. `near` are the colliders
/// that may touch it. Returns its new state.
SHARED_FN BladeState advanceBlade(Blade blade, Environment environment, ColliderMask near,
                                  BladeState state, float time, float elapsed)
{
    const BladeAxes axes = axesAlong(blade.up, widthAxis(blade.up, blade.facing));
    // Contact fades within 1/a seconds, a = (1 − b)/2 … 1/2 as in the demo.
    const float fade = 0.5f * max(blade.stiffness, 0.1f);
    const uint steps = uint(clamp(ceil(elapsed / longestStep), 1.0f, float(maxSteps)));
    const float dt = elapsed / float(steps);

    const vec3 pull = environmentAt(environment.gravity, blade.root);
    vec3 gravity = alongAxes(axes, pull);
    gravity.x += environment.gravity.forward * length(pull);
    const vec2 first = storedTurn(state);
    vec2 turn = first;
    float eta = state.eta;
    float pushed = 0.0f;
    bool resting = true;
    for (uint i = 0u; i < steps; ++i) {
        const float back = elapsed - dt * float(i + 1u);
        eta = max(eta - fade * dt, 0.0f);
        const vec3 direction = directionOfTurn(turn);
        const float radius = tipDistance(direction);
        const float before = pushed;
        // Use the wind at the middle of the step.
        const vec3 wind =
            windAlongAxes(environment.wind, blade.root, axes, direction, time - back - 0.5f * dt);
        turn = turnAbove(relaxTurn(blade.stiffness, gravity + (radius * direction.z) * wind,
                                   environment.recovery, turn, direction.z < lyingBelow, radius,
                                   eta, dt));
        if (environment.colliderCount > 0u) {
            const vec3 moved = directionOfTurn(turn);
            const vec3 tip = pushBlade(
                blade, axes.front, environment.colliders, near, inSpace(axes, radius * direction),
                inSpace(axes, tipDistance(moved) * moved), back, pushed, resting);
            // Without contact the result equals that without colliders, to the bit.
            if (pushed > before)
                turn = turnTowards(alongAxes(axes, normalize(tip)));
            eta = min(eta + (pushed - before), 1.0f);
        }
    }
    if (pushed > 0.0f && resting) {
        const vec3 from = directionOfTurn(first);
        const vec3 to = directionOfTurn(turn);
        if (length(tipDistance(to) * to - tipDistance(from) * from) < stickingSpeed * elapsed)
            return state;
    }
    return stateOfTurn(turn, eta);
}

SHARED_END
#endif
