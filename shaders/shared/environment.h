// Environment of a field's blades: gravity, wind sources, colliders. The forces themselves are in
// wind.h and physics.h.
#ifndef SWARD_SHARED_ENVIRONMENT_H
#define SWARD_SHARED_ENVIRONMENT_H

#include "shaders/shared/collision.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Kinds of sources.
SHARED_CONST uint windNoise = 0u;   ///< a direction times value noise that moves with the wind
SHARED_CONST uint windTurning = 1u; ///< a sine of the time, in a direction that may turn
SHARED_CONST uint windWave = 2u;    ///< the paper's directional wave
SHARED_CONST uint windRadial = 3u;  ///< the paper's helicopter: rings around a centre
SHARED_CONST uint windSwirl = 4u;   ///< the paper's swirl: away from a centre and around it
SHARED_CONST uint windGusts = 5u;   ///< fronts that rise quickly and decay slowly
SHARED_CONST uint windKinds = 6u;

/// In Wind::counts: all sources blow alike, see blowsLike().
SHARED_CONST uint windsAlike = 1u << 24u;

/// Maximum number of active sources.
SHARED_CONST uint maxWindSources = 8u;

/// One source of wind. A kind may leave fields unused.
struct WindSource {
    vec3 direction;  ///< unit; blowing direction (not radial, swirl)
    float strength;  ///< [1/s] maximum pull on a blade across it, in its heights per second
    vec3 centre;     ///< [m] relative to the field's origin (radial, swirl)
    float size;      ///< [m] > 0: noise: grain along the wind, half of that across; turning,
                     ///< wave: from crest to crest; gusts: from front to front; radial, swirl:
                     ///< distance at which the wind ends
    float speed;     ///< [m/s] speed of noise, waves, rings and fronts
    float rate;      ///< [rad/s] of the sine (turning)
    float turn;      ///< [rad/s] of the direction about the blade's up-vector (turning)
    float alignment; ///< [0, 1] reduction for a blade that lies along the wind
    float lift;      ///< [0, 1] share that is kept of the wind along the blade's up-vector
    uint kind;       ///< windNoise …
    vec3 side;       ///< see preparedSource(), as for perSize
    float perSize;   ///< [1/m] 1/size
};
SHARED_LAYOUT(WindSource, 72)

/// How far a source's pattern has moved at the time of a frame. The CPU computes it in double
/// precision, so that single precision holds no time but that since the frame. windPhaseAtZero() is
/// that of time 0. A kind may leave fields unused.
struct WindPhase {
    vec3 shift;     ///< [cells] of the noise, along the world's axes, less whole cells; gusts: x is
                    ///< the number of fronts, less whole fronts
    uint cell;      ///< latticePoint() of the whole cells (noise), of the whole fronts (gusts)
    vec3 fineShift; ///< likewise of the finer noise
    uint fineCell;
    float angle;  ///< [rad] by which the pattern has moved on, less whole periods (wave, radial,
                  ///< swirl); of the sine (turning)
    float turned; ///< [rad] of the direction, less whole turns (turning)
};
SHARED_LAYOUT(WindPhase, 40)

/// Places of a field in the pattern of the world's wind, so that fields share one pattern.
struct WindLattice {
    vec3 origin; ///< [m] the field's origin there, along the field's axes
    vec3 x;      ///< unit; the world's axes along the field's
    vec3 y;      ///< likewise
    vec3 z;      ///< likewise
};
SHARED_LAYOUT(WindLattice, 48)

/// All active sources. If `counts` is known when a shader is compiled, absent kinds cost nothing.
struct Wind {
    uint counts;     ///< number of sources of each kind, four bits each from the lowest; and
                     ///< windsAlike
    float eddySize;  ///< [m] > 0: size of the eddies where wind meets the ground head-on
    float eddySpeed; ///< [m/s] speed of the eddies
    float sum;       ///< [1/s] of all strengths
    vec3 eddyPhase;  ///< [periods] by which the eddies have moved on, less whole periods
    WindLattice lattice;
    WindSource sources[maxWindSources]; ///< sorted by kind
    WindPhase phases[maxWindSources];   ///< of the same sources
};
SHARED_LAYOUT(Wind, 972)

/// The pull of gravity: a direction, an attractor, or a blend of both.
struct Gravity {
    vec3 direction; ///< unit
    float strength; ///< [1/s] in heights per second
    vec3 attractor; ///< [m] relative to the field's origin: a planet's centre
    float blend;    ///< [0, 1]: 0 direction only, 1 attractor only
    float forward;  ///< [0, 1] share of the pull that leans a blade forward; a quarter in the paper
};
SHARED_LAYOUT(Gravity, 36)

/// Gravity::forward of the paper.
SHARED_CONST float forwardShare = 0.25f;

/// Gravity, wind and colliders of a field in one frame.
struct Environment {
    Gravity gravity;
    float recovery;     ///< [1/s] rate at which a stiff blade rises again
    uint colliderCount; ///< 0: no blade tests colliders
    Wind wind;
    ColliderTable colliders;
};
SHARED_LAYOUT(Environment, 1024)

SHARED_END
#endif
