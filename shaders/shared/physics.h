// How a blade moves: Jahrmann & Wimmer, "Responsive Real-Time Grass Rendering for General 3D
// Scenes", I3D 2017, section 5, in units of the blade's own height and relative to its root.
#ifndef SWARD_SHARED_PHYSICS_H
#define SWARD_SHARED_PHYSICS_H

#include "shaders/shared/bezier.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/types.h"
#include "shaders/shared/wind.h"

SHARED_BEGIN

/// What moves between frames, 8 bytes: the tip's displacement from rest in heights, and the
/// strength of the last collision.
struct BladeState {
    uint xy;   ///< snorm16 × 2: displacement.x, displacement.y in ±2 heights
    uint zEta; ///< snorm16: displacement.z; unorm16: collision strength in [0, 1]
};
SHARED_LAYOUT(BladeState, 8)

SHARED_BUFFER(StateArray, BladeState, )

/// The pull of gravity: a direction, an attractor, or a blend of both.
struct Gravity {
    vec3 direction; ///< unit
    float strength; ///< [1/s] in heights per second
    vec3 attractor; ///< [m] relative to the field's origin: a planet's centre
    float blend;    ///< [0, 1]: 0 direction only, 1 attractor only
};
SHARED_LAYOUT(Gravity, 32)

/// A blade's control points relative to its root, in heights; v0 is the origin.
struct Pose {
    vec3 v1;
    vec3 v2;
};

/// Half of a step of the stored displacement and the rounding of a number near 2, in heights, per
/// axis.
SHARED_CONST float displacementMaxError = 3.07e-5f;

SHARED_FN uint packSnorm16(float x)
{
    return uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;
}

SHARED_FN float unpackSnorm16(uint bits)
{
    return float((int(bits & 65535u) ^ 32768) - 32768) / 32767.0f;
}

SHARED_FN BladeState packState(vec3 displacement, float eta)
{
    BladeState state;
    state.xy = packSnorm16(displacement.x * 0.5f) | (packSnorm16(displacement.y * 0.5f) << 16u);
    state.zEta = packSnorm16(displacement.z * 0.5f) |
                 (uint(floor(clamp(eta, 0.0f, 1.0f) * 65535.0f + 0.5f)) << 16u);
    return state;
}

SHARED_FN vec3 displacementOf(BladeState state)
{
    return 2.0f *
           vec3(unpackSnorm16(state.xy), unpackSnorm16(state.xy >> 16u), unpackSnorm16(state.zEta));
}

SHARED_FN float etaOf(BladeState state)
{
    return float(state.zEta >> 16u) / 65535.0f;
}

/// Gravity at `root` [m] with its elastic forward part: g = gE + ¼·‖gE‖·front (section 5.1).
SHARED_FN vec3 gravityAt(Gravity gravity, vec3 root, vec3 front)
{
    const vec3 toAttractor = gravity.attractor - root;
    const float distance = length(toAttractor);
    const vec3 pull = distance > 1e-6f ? toAttractor / distance : vec3(0.0f);
    const vec3 environment = gravity.strength * mix(gravity.direction, pull, gravity.blend);
    return environment + 0.25f * length(environment) * front;
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
    // A tip on the root has no direction: let the blade lie down forward.
    const float distance = length(lifted);
    const vec3 towards = distance > 1e-4f ? lifted / distance : front;
    // Division has magnified the rounding of the first step: lift again.
    const vec3 direction = towards - up * min(dot(up, towards), 0.0f);
    const float side = length(direction - up * dot(direction, up));
    const vec3 v1 = up * max(1.0f - side, 0.05f);
    const float scale = 1.0f / bezierLength(v1, direction);
    Pose pose;
    pose.v1 = v1 * scale;
    pose.v2 = direction * scale;
    return pose;
}

/// The pose that a stored state stands for.
SHARED_FN Pose poseOfState(vec3 up, vec3 front, BladeState state)
{
    return poseBlade(up, front, up + displacementOf(state));
}

/// One step of `dt` [s] (section 5.2): δ' = δ + (recovery + gravity + wind)·dt, solved exactly for
/// forces that stand still during the step: the displacement relaxes towards δ* = (g + w)/k with
/// rate k, so a long step is safe. With b = 1 − stiffness, as in the authors' demo, gravity and
/// wind count b and recovery 1 − b/4; collision strength eta softens recovery.
SHARED_FN vec3 relaxDisplacement(Blade blade, vec3 front, Gravity gravity, vec3 wind,
                                 float recovery, vec3 displacement, float eta, float dt)
{
    const float b = 1.0f - blade.stiffness;
    const float k = recovery * (1.0f - 0.25f * b) * max(1.0f - eta, 0.1f);
    const vec3 tip = blade.up + displacement;

    // Wind counts for what faces it, and for a blade that stands up (section 5.1).
    const float windLength = length(wind);
    const float tipLength = length(tip);
    float share = 0.0f;
    if (windLength > 1e-6f && tipLength > 1e-6f)
        share =
            (1.0f - abs(dot(wind, tip)) / (windLength * tipLength)) * max(dot(tip, blade.up), 0.0f);

    const vec3 forces = b * (gravityAt(gravity, blade.root, front) + share * wind);
    const vec3 rest = forces / max(k, 1e-3f);
    return rest + (displacement - rest) * exp(-k * dt);
}

/// Longest time the forces are taken to stand still [s], and how often at most one frame is
/// divided.
SHARED_CONST float longestStep = 0.034f;
SHARED_CONST uint maxSteps = 16u;

/// Moves a blade by the time `elapsed` [s] up to `time`, however long. Returns its new state.
SHARED_FN BladeState advanceBlade(Blade blade, Gravity gravity, Wind wind, float recovery,
                                  BladeState state, float time, float elapsed)
{
    const vec3 front = frontOf(blade.up, widthAxis(blade.up, blade.facing));
    // Contact fades within 1/a seconds, a = (1 − b)/2 … 1/2 as in the demo.
    const float fade = 0.5f * max(blade.stiffness, 0.1f);
    const uint steps = uint(clamp(ceil(elapsed / longestStep), 1.0f, float(maxSteps)));
    const float dt = elapsed / float(steps);

    vec3 displacement = displacementOf(state);
    float eta = etaOf(state);
    for (uint i = 0u; i < steps; ++i) {
        const float now = time - elapsed + dt * float(i + 1u);
        eta = max(eta - fade * dt, 0.0f);
        displacement = relaxDisplacement(blade, front, gravity, windAt(wind, blade.root, now),
                                         recovery, displacement, eta, dt);
        const Pose pose = poseBlade(blade.up, front, blade.up + displacement);
        displacement = pose.v2 - blade.up;
    }
    return packState(displacement, eta);
}

SHARED_END
#endif
