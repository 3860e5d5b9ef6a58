// What moves the blades of a field: gravity, the wind's sources, colliders. The forces themselves
// are in wind.h and physics.h.
#ifndef SWARD_SHARED_ENVIRONMENT_H
#define SWARD_SHARED_ENVIRONMENT_H

#include "shaders/shared/collision.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Kinds of sources.
SHARED_CONST uint windNoise = 0u;   ///< a direction times value noise that the wind carries along
SHARED_CONST uint windTurning = 1u; ///< a sine of the time, whose direction may turn
SHARED_CONST uint windWave = 2u;    ///< the paper's directional wave
SHARED_CONST uint windRadial = 3u;  ///< the paper's helicopter: rings away from a centre
SHARED_CONST uint windSwirl = 4u;   ///< the paper's swirl: away from a centre and around it
SHARED_CONST uint windGusts = 5u;   ///< fronts that rise quickly and die away slowly
SHARED_CONST uint windKinds = 6u;

/// In Wind::counts: all sources blow like the first, see blowsLike().
SHARED_CONST uint windsAlike = 1u << 24u;

/// Sources that blow at once.
SHARED_CONST uint maxWindSources = 8u;

/// One source of wind. Not every kind uses every number.
struct WindSource {
    vec3 direction;  ///< unit; where it blows to (not radial, swirl)
    float strength;  ///< [1/s] largest pull on a blade across it, in its heights per second
    vec3 centre;     ///< [m] relative to the field's origin (radial, swirl)
    float size;      ///< [m] > 0: noise: its grain along the wind, half of that across; turning,
                     ///< wave: from crest to crest; gusts: from front to front; radial, swirl:
                     ///< distance at which nothing is felt any more
    float speed;     ///< [m/s] at which noise, waves, rings and fronts travel
    float rate;      ///< [rad/s] of the sine (turning)
    float turn;      ///< [rad/s] of the direction about the blade's up-vector (turning)
    float alignment; ///< [0, 1] how much a blade that lies along the wind escapes it
    float lift;      ///< [0, 1] share that is kept of what blows along the blade's up-vector
    uint kind;       ///< windNoise …
    vec3 side;       ///< see preparedSource(), as the next one
    float perSize;   ///< [1/m] 1/size
};
SHARED_LAYOUT(WindSource, 72)

/// All that blows at once. Where `counts` is known when a shader is compiled, kinds that do not
/// blow cost nothing.
struct Wind {
    uint counts;     ///< four bits for each kind, from the lowest: how many sources it has; and
                     ///< windsAlike
    float eddySize;  ///< [m] > 0 of the eddies where wind meets the ground head-on
    float eddySpeed; ///< [m/s] at which they travel
    float sum;       ///< [1/s] of all strengths
    WindSource sources[maxWindSources]; ///< kind after kind
};
SHARED_LAYOUT(Wind, 592)

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

/// What moves every blade of a field in one frame.
struct Environment {
    Gravity gravity;
    float recovery;     ///< [1/s] rate at which a stiff blade rises again
    uint colliderCount; ///< 0: no blade asks for colliders
    uint reserved;
    Wind wind;
    ColliderTable colliders;
};
SHARED_LAYOUT(Environment, 648)

SHARED_END
#endif
