// The wind: the sum of several kinds of sources, one vector for each place and time. On curved
// ground each blade feels the wind along its own ground plane. docs/algorithms/wind.md
#ifndef SWARD_SHARED_WIND_H
#define SWARD_SHARED_WIND_H

#include "shaders/shared/blade.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Source `i` of a wind, its phase, and the wind's lattice. A stage with constant sources defines
/// them before it includes this file: then they take no registers.
#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) wind.sources[i]
#define WIND_PHASE(wind, i) wind.phases[i]
#define WIND_LATTICE(wind) wind.lattice
#endif

SHARED_FN uint windCount(uint counts, uint kind)
{
    return (counts >> (4u * kind)) & 15u;
}

/// A source with its derived fields: a unit vector across its direction, level except for a
/// vertical wind, and 1/size.
SHARED_FN WindSource preparedSource(WindSource source)
{
    WindSource prepared = source;
    prepared.side = abs(source.direction.y) < 0.99f
                        ? normalize(cross(source.direction, vec3(0.0f, 1.0f, 0.0f)))
                        : vec3(1.0f, 0.0f, 0.0f);
    prepared.perSize = 1.0f / source.size;
    return prepared;
}

/// Whether two sources differ only in their amounts, so that a blade's reaction to their sum equals
/// the sum of the reactions. See windsAlike.
SHARED_FN bool blowsLike(WindSource a, WindSource b)
{
    const bool hasAmounts = (a.kind == windNoise || a.kind == windWave || a.kind == windGusts) &&
                            (b.kind == windNoise || b.kind == windWave || b.kind == windGusts);
    return hasAmounts && a.direction == b.direction && a.alignment == b.alignment &&
           a.lift == b.lift;
}

// Every `time` below [s] is counted from the time of the wind's phases. A blade's motion asks for
// times up to its last update, so it is short.

/// Where the finer of two lattices of noise begins, so that their cells do not coincide [cells].
SHARED_CONST float fineNoiseStart = 17.3f;

/// Cells of the finer noise in one of the coarser.
SHARED_CONST float fineNoiseScale = 2.7f;

/// Rows of the lattice from one gust front to the next.
SHARED_CONST uint gustRows = 7u;

/// The phase of any source at time 0.
SHARED_FN WindPhase windPhaseAtZero()
{
    WindPhase phase;
    phase.shift = vec3(0.0f);
    phase.cell = 0u;
    phase.fineShift = vec3(fineNoiseStart);
    phase.fineCell = 0u;
    phase.angle = 0.0f;
    phase.turned = 0.0f;
    return phase;
}

/// Height of the travelling wave at a place, in [0, 1]: three sines of different direction and
/// length, as in the directional wave of Jahrmann & Wimmer's demo, along the wind instead of the x
/// axis.
SHARED_FN float windWaveAt(WindSource source, WindPhase phase, vec3 position, float time)
{
    const float k = 6.2831853f * source.perSize;
    const float along = k * (dot(position, source.direction) - source.speed * time) - phase.angle;
    const float across = k * dot(position, source.side);
    const float sum = cos(0.9f * along + 0.4f * across) + sin(0.55f * along - 0.25f * across) +
                      sin(0.3f * along + 0.6f * across);
    return 1.0f - max(sum / 3.0f, 0.0f);
}

/// A vector along the world's axes, plus `shift`: noise is the same for fields that are turned
/// differently. One chain of multiply-adds for each axis.
SHARED_FN vec3 inLattice(Wind wind, vec3 v, vec3 shift)
{
    const vec3 x = WIND_LATTICE(wind).x;
    const vec3 y = WIND_LATTICE(wind).y;
    const vec3 z = WIND_LATTICE(wind).z;
    return vec3(((shift.x + x.x * v.x) + x.y * v.y) + x.z * v.z,
                ((shift.y + y.x * v.x) + y.y * v.y) + y.z * v.z,
                ((shift.z + z.x * v.x) + z.y * v.y) + z.z * v.z);
}

/// Amount in [0, 2] of the noise that moves with the wind. Level ground cuts a plane out of the
/// lattice: there it is noise in two dimensions, with a grain of `size` along the wind and twice
/// that across. The position is stretched by half across.
SHARED_FN float windNoiseAt(Wind wind, WindSource source, WindPhase phase, vec3 position,
                            float time)
{
    const float along = dot(position, source.direction) - 2.0f * source.speed * time;
    const vec3 stretched = inLattice(
        wind, (0.5f * source.perSize) * (position + source.direction * along), phase.shift);
    const float gust =
        0.65f * valueNoiseFrom(phase.cell, stretched) +
        0.35f * valueNoiseFrom(phase.fineCell, fineNoiseScale * stretched + phase.fineShift);
    return 2.0f * gust * gust;
}

/// Share of a front's spacing over which it rises.
SHARED_CONST float gustRise = 0.12f;

/// Amount in [0, 1] of the gust fronts: successive fronts, each bent by noise, with varying
/// strength along its length, 0 between two fronts.
SHARED_FN float windGustAt(Wind wind, WindSource source, WindPhase phase, vec3 position, float time)
{
    const float along = dot(position, source.direction);
    const vec3 across =
        inLattice(wind, source.perSize * (position - source.direction * along), vec3(0.0f));
    const float bend = 0.8f * (valueNoise(0.7f * across + vec3(5.1f)) - 0.5f) + phase.shift.x;
    // Behind a front the number of fronts grows: the wind rises first, and then decays.
    const float fronts = (source.speed * time - along) * source.perSize + bend;
    const float front = floor(fronts);
    const float s = fronts - front;
    const float rise = clamp(s / gustRise, 0.0f, 1.0f);
    const float fall = clamp((1.0f - s) / (1.0f - gustRise), 0.0f, 1.0f);
    const float profile = rise * rise * (3.0f - 2.0f * rise) * fall * fall;
    // Each front has its own row in the lattice.
    const float own =
        valueNoiseFrom(phase.cell, across + vec3(0.0f, 0.0f, float(gustRows) * front));
    return profile * clamp(2.0f * own - 0.2f, 0.0f, 1.0f);
}

/// A sine of period 1 made of parabolas, within 0.06 of it.
SHARED_FN vec3 parabolicSine(vec3 x)
{
    const vec3 f = 2.0f * fract(x) - vec3(1.0f);
    return -4.0f * f * (vec3(1.0f) - abs(f));
}

/// Eddies, of length around 1 in any plane: a divergence-free, drifting flow of the
/// Arnold–Beltrami–Childress kind. `phase`: Wind::eddyPhase.
SHARED_CONST vec3 eddyDrift = vec3(0.48f, 0.57f, 0.67f);

SHARED_FN vec3 windEddies(float size, float speed, vec3 phase, vec3 position, float time)
{
    const vec3 q = (position + eddyDrift * (speed * time)) / size + phase;
    const vec3 s = parabolicSine(q);
    const vec3 c = parabolicSine(q + vec3(0.25f));
    return 0.7f * (vec3(s.z, s.x, s.y) + vec3(c.y, c.z, c.x));
}

/// Sizes of radial and swirling sources in the paper's units of length.
SHARED_CONST float radialExtent = 75.0f;
SHARED_CONST float swirlExtent = 30.0f;

/// Radial and swirling sources at `arm` [m] from their centre, over ground with unit `up`, per
/// strength. Uses the demo's numbers, with these extents as `size`. Near the centre
/// the direction fades out, so that it is defined everywhere.
SHARED_FN vec3 windAround(WindSource source, WindPhase phase, vec3 arm, vec3 up, float time,
                          bool isSwirl)
{
    const float distance = length(arm);
    // Calm within a hundredth of the size around the centre.
    const vec3 away = arm / (distance + 0.01f * source.size);
    const float unit = (isSwirl ? swirlExtent : radialExtent) / source.size;
    const float r = unit * distance;
    const float fade = max(1.0f - 0.25f * log2((isSwirl ? 0.5f : 0.2f) * r + 1.0f), 0.0f);
    const float along = r - unit * source.speed * time - phase.angle;
    if (!isSwirl)
        return away * (fade * (1.0f - max(sin(0.4f * along), 0.0f)));
    const float ring = sin(0.1f * along);
    return (away + 1.5f * (1.0f - fade * fade) * cross(up, away)) * (fade * ring * ring * ring);
}

/// A wind's amount times direction, per strength, over ground with unit `up`. The component into or
/// out of the ground is turned into `eddies`: so no place of a sphere is always calm, and there is
/// no division by the remaining component.
SHARED_FN vec3 windAlong(Wind wind, WindSource source, vec3 direction, float amount, vec3 position,
                         vec3 up, float time)
{
    const float head = (1.0f - source.lift) * abs(dot(source.direction, up));
    vec3 flow = direction;
    if (head > 0.0f) // 0 on level ground
        flow += head * windEddies(wind.eddySize, wind.eddySpeed, wind.eddyPhase, position, time);
    return amount * flow;
}

/// The effect of `flow` on a blade whose tip lies in unit `direction`, along its axes. Along the
/// ground only, except for `lift`; reduced if the blade lies along the wind (Jahrmann & Wimmer,
/// section 5.1). No reduction for a zero direction. The result is along the blade's axes.
SHARED_FN vec3 windFelt(WindSource source, vec3 flow, BladeAxes axes, vec3 direction)
{
    vec3 wind = alongAxes(axes, flow);
    wind.z *= source.lift;
    const float square = dot(wind, wind);
    const float along = square > 1e-12f ? abs(dot(wind, direction)) * inversesqrt(square) : 0.0f;
    return (1.0f - source.alignment * along) * wind;
}

/// Sum of amount times strength over sources that blow alike.
SHARED_FN float windAmount(Wind wind, vec3 position, float time)
{
    float sum = 0.0f;
    uint next = 0u;
    for (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += source.strength * windNoiseAt(wind, source, phase, position, time);
    }
    for (uint i = windCount(wind.counts, windWave); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        const float wave = windWaveAt(source, phase, position, time);
        sum += source.strength * wave * wave;
    }
    for (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += source.strength * windGustAt(wind, source, phase, position, time);
    }
    return sum;
}

/// The effect on a blade of sources that blow alike with `amount`, see windAmount(); linear in
/// `amount`.
SHARED_FN vec3 windOfAmount(Wind wind, float amount, vec3 position, BladeAxes axes, vec3 direction,
                            float time)
{
    const WindSource source = WIND_SOURCE(wind, 0);
    return amount *
           windFelt(source,
                    windAlong(wind, source, source.direction, 1.0f, position, axes.up, time), axes,
                    direction);
}

/// Sum over all sources of the effect on a blade at `root` [m], relative to the field's origin;
/// see windFelt(). Below, `position` is a place of the lattice, see WindLattice.
SHARED_FN vec3 windAlongAxes(Wind wind, vec3 root, BladeAxes axes, vec3 direction, float time)
{
    const vec3 position = root + WIND_LATTICE(wind).origin;
    if ((wind.counts & windsAlike) != 0u)
        return windOfAmount(wind, windAmount(wind, position, time), position, axes, direction,
                            time);
    vec3 sum = vec3(0.0f);
    uint next = 0u;
    for (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        const float amount = source.strength * windNoiseAt(wind, source, phase, position, time);
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windTurning); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        const float angle = source.turn * time + phase.turned;
        const vec3 turned =
            source.direction * cos(angle) + cross(axes.up, source.direction) * sin(angle);
        const float amount =
            source.strength * sin(source.rate * time + phase.angle -
                                  (6.2831853f * source.perSize) * dot(position, source.direction));
        sum += windFelt(source, windAlong(wind, source, turned, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windWave); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        const float wave = windWaveAt(source, phase, position, time);
        const float amount = source.strength * wave * wave;
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windRadial); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += windFelt(source,
                        source.strength *
                            windAround(source, phase, root - source.centre, axes.up, time, false),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windSwirl); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += windFelt(source,
                        source.strength *
                            windAround(source, phase, root - source.centre, axes.up, time, true),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {
        const WindPhase phase = WIND_PHASE(wind, next);
        const WindSource source = WIND_SOURCE(wind, next++);
        const float amount = source.strength * windGustAt(wind, source, phase, position, time);
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, amount, position, axes.up, time),
                        axes, direction);
    }
    return sum;
}

/// The wind at `position` [m] and `time` [s] over ground with unit `up`, in blade heights per
/// second.
SHARED_FN vec3 windAt(Wind wind, vec3 position, vec3 up, float time)
{
    const BladeAxes axes = axesTowards(up, tangentOf(up));
    return inSpace(axes, windAlongAxes(wind, position, axes, vec3(0.0f), time));
}

/// The wind's force on a blade with its tip at `tip` heights from the root: the force falls as the
/// blade lies down.
SHARED_FN vec3 windForce(Wind wind, vec3 root, vec3 up, vec3 tip, float time)
{
    const BladeAxes axes = axesTowards(up, tangentOf(up));
    const vec3 direction = alongAxes(axes, tip / max(length(tip), 1e-6f));
    return max(dot(tip, up), 0.0f) *
           inSpace(axes, windAlongAxes(wind, root, axes, direction, time));
}

SHARED_END
#endif
