// The wind: sources of several kinds that add up to one vector for every place and time. Along
// curved ground each blade feels what blows along its own ground plane. docs/algorithms/wind.md
#ifndef SWARD_SHARED_WIND_H
#define SWARD_SHARED_WIND_H

#include "shaders/shared/blade.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Source `i` of a wind. A stage that has all of them as constants names them so before it includes
/// this: then what they say takes no registers.
#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) wind.sources[i]
#endif

SHARED_FN uint windCount(uint counts, uint kind)
{
    return (counts >> (4u * kind)) & 15u;
}

/// A source with what follows from the rest of it: a unit vector across its direction, level but
/// for a wind that blows straight up or down, and 1/size.
SHARED_FN WindSource preparedSource(WindSource source)
{
    WindSource prepared = source;
    prepared.side = abs(source.direction.y) < 0.99f
                        ? normalize(cross(source.direction, vec3(0.0f, 1.0f, 0.0f)))
                        : vec3(1.0f, 0.0f, 0.0f);
    prepared.perSize = 1.0f / source.size;
    return prepared;
}

/// Whether sources of two kinds that only differ in their amounts are felt alike: of their sum a
/// blade feels as much as of each of them together. See windsAlike.
SHARED_FN bool blowsLike(WindSource a, WindSource b)
{
    const bool hasAmounts = (a.kind == windNoise || a.kind == windWave || a.kind == windGusts) &&
                            (b.kind == windNoise || b.kind == windWave || b.kind == windGusts);
    return hasAmounts && a.direction == b.direction && a.alignment == b.alignment &&
           a.lift == b.lift;
}

/// Height of the travelling wave at a place, in [0, 1]: three sines of unlike direction and length,
/// as in the directional wave of Jahrmann & Wimmer's demo, laid along the wind instead of the x
/// axis.
SHARED_FN float windWaveAt(WindSource source, vec3 position, float time)
{
    const float k = 6.2831853f * source.perSize;
    const float along = k * (dot(position, source.direction) - source.speed * time);
    const float across = k * dot(position, source.side);
    const float sum = cos(0.9f * along + 0.4f * across) + sin(0.55f * along - 0.25f * across) +
                      sin(0.3f * along + 0.6f * across);
    return 1.0f - max(sum / 3.0f, 0.0f);
}

/// Amount in [0, 2] of the noise that the wind carries along. Level ground cuts a plane out of the
/// lattice: there it is noise in two dimensions, with a grain of `size` along the wind and twice
/// that across. The position is stretched by half across.
SHARED_FN float windNoiseAt(WindSource source, vec3 position, float time)
{
    const float along = dot(position, source.direction) - 2.0f * source.speed * time;
    const vec3 stretched = (0.5f * source.perSize) * (position + source.direction * along);
    const float gust =
        0.65f * valueNoise(stretched) + 0.35f * valueNoise(2.7f * stretched + vec3(17.3f));
    return 2.0f * gust * gust;
}

/// Share of a front's spacing over which it rises.
SHARED_CONST float gustRise = 0.12f;

/// Amount in [0, 1] of the gust fronts: front after front, each bent by noise, of its own strength
/// along its length, 0 between one and the next.
SHARED_FN float windGustAt(WindSource source, vec3 position, float time)
{
    const float along = dot(position, source.direction);
    const vec3 across = source.perSize * (position - source.direction * along);
    const float bend = 0.8f * (valueNoise(0.7f * across + vec3(5.1f)) - 0.5f);
    // Behind a front the phase grows: what is felt rises first, and then dies away.
    const float phase = (source.speed * time - along) * source.perSize + bend;
    const float front = floor(phase);
    const float s = phase - front;
    const float rise = clamp(s / gustRise, 0.0f, 1.0f);
    const float fall = clamp((1.0f - s) / (1.0f - gustRise), 0.0f, 1.0f);
    const float profile = rise * rise * (3.0f - 2.0f * rise) * fall * fall;
    // Each front has a row of its own in the lattice.
    const float own = valueNoise(across + vec3(0.0f, 0.0f, 7.0f * front));
    return profile * clamp(2.0f * own - 0.2f, 0.0f, 1.0f);
}

/// A sine of period 1 made of parabolas, within 0.06 of it.
SHARED_FN vec3 parabolicSine(vec3 x)
{
    const vec3 f = 2.0f * fract(x) - vec3(1.0f);
    return -4.0f * f * (vec3(1.0f) - abs(f));
}

/// Eddies, of length around 1 in any plane: a flow of the Arnold–Beltrami–Childress kind, free of
/// divergence, that drifts by.
SHARED_FN vec3 windEddies(float size, float speed, vec3 position, float time)
{
    const vec3 q = (position + vec3(0.48f, 0.57f, 0.67f) * (speed * time)) / size;
    const vec3 s = parabolicSine(q);
    const vec3 c = parabolicSine(q + vec3(0.25f));
    return 0.7f * (vec3(s.z, s.x, s.y) + vec3(c.y, c.z, c.x));
}

/// Radial and swirling sources at `arm` [m] from their centre, over ground with unit `up`, per
/// strength. The demo's numbers are kept, with its 75 and 30 length units as `size`. Near the
/// centre the direction fades out, so that no place has none.
SHARED_FN vec3 windAround(WindSource source, vec3 arm, vec3 up, float time, bool isSwirl)
{
    const float distance = length(arm);
    // A hundredth of the size around the centre is still.
    const vec3 away = arm / (distance + 0.01f * source.size);
    const float extent = isSwirl ? 30.0f : 75.0f;
    const float unit = extent / source.size;
    const float r = unit * distance;
    const float fade = max(1.0f - 0.25f * log2((isSwirl ? 0.5f : 0.2f) * r + 1.0f), 0.0f);
    const float along = r - unit * source.speed * time;
    if (!isSwirl)
        return away * (fade * (1.0f - max(sin(0.4f * along), 0.0f)));
    const float ring = sin(0.1f * along);
    return (away + 1.5f * (1.0f - fade * fade) * cross(up, away)) * (fade * ring * ring * ring);
}

/// The amount of a wind with a direction, per strength, over ground with unit `up`. What would blow
/// into the ground or out of it is turned aside into `eddies`, so that no place of a ball is always
/// calm, and nothing is divided by what is left along the ground.
SHARED_FN vec3 windAlong(Wind wind, WindSource source, vec3 direction, float amount, vec3 position,
                         vec3 up, float time)
{
    const float head = (1.0f - source.lift) * abs(dot(source.direction, up));
    vec3 flow = direction;
    if (head > 0.0f) // as nowhere on level ground
        flow += head * windEddies(wind.eddySize, wind.eddySpeed, position, time);
    return amount * flow;
}

/// What a blade whose tip is seen in `direction`, unit and along its axes, feels of `flow`: along
/// the ground alone, but for `lift`; and less where the blade lies along it (Jahrmann & Wimmer,
/// section 5.1). One without a direction feels all. Along the blade's axes.
SHARED_FN vec3 windFelt(WindSource source, vec3 flow, BladeAxes axes, vec3 direction)
{
    vec3 wind = alongAxes(axes, flow);
    wind.z *= source.lift;
    const float square = dot(wind, wind);
    const float along = square > 1e-12f ? abs(dot(wind, direction)) * inversesqrt(square) : 0.0f;
    return (1.0f - source.alignment * along) * wind;
}

/// Sum of the amounts, times strength, of sources that blow alike.
SHARED_FN float windAmount(Wind wind, vec3 position, float time)
{
    float sum = 0.0f;
    uint next = 0u;
    for (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += source.strength * windNoiseAt(source, position, time);
    }
    for (uint i = windCount(wind.counts, windWave); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        const float wave = windWaveAt(source, position, time);
        sum += source.strength * wave * wave;
    }
    for (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += source.strength * windGustAt(source, position, time);
    }
    return sum;
}

/// What a blade feels of sources that blow alike with `amount`, see windAmount(), in whose sum it
/// is linear.
SHARED_FN vec3 windOfAmount(Wind wind, float amount, vec3 position, BladeAxes axes, vec3 direction,
                            float time)
{
    const WindSource source = WIND_SOURCE(wind, 0);
    return amount *
           windFelt(source,
                    windAlong(wind, source, source.direction, 1.0f, position, axes.up, time), axes,
                    direction);
}

/// Sum over all sources of what a blade feels at `position`; see windFelt().
SHARED_FN vec3 windAlongAxes(Wind wind, vec3 position, BladeAxes axes, vec3 direction, float time)
{
    if ((wind.counts & windsAlike) != 0u)
        return windOfAmount(wind, windAmount(wind, position, time), position, axes, direction,
                            time);
    vec3 sum = vec3(0.0f);
    uint next = 0u;
    for (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        const float amount = source.strength * windNoiseAt(source, position, time);
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windTurning); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        const float angle = source.turn * time;
        const vec3 turned =
            source.direction * cos(angle) + cross(axes.up, source.direction) * sin(angle);
        const float amount =
            source.strength * sin(source.rate * time -
                                  (6.2831853f * source.perSize) * dot(position, source.direction));
        sum += windFelt(source, windAlong(wind, source, turned, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windWave); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        const float wave = windWaveAt(source, position, time);
        const float amount = source.strength * wave * wave;
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, amount, position, axes.up, time),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windRadial); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += windFelt(source,
                        source.strength *
                            windAround(source, position - source.centre, axes.up, time, false),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windSwirl); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        sum += windFelt(source,
                        source.strength *
                            windAround(source, position - source.centre, axes.up, time, true),
                        axes, direction);
    }
    for (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {
        const WindSource source = WIND_SOURCE(wind, next++);
        const float amount = source.strength * windGustAt(source, position, time);
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

/// What of the wind pulls at a blade with its tip at `tip` heights from the root: less the more the
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
