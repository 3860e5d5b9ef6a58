// The wind: sources of several kinds that add up to one vector for every place and time. Along
// curved ground each blade feels what blows along its own ground plane. docs/algorithms/wind.md
#ifndef SWARD_SHARED_WIND_H
#define SWARD_SHARED_WIND_H

#include "shaders/shared/noise.h"
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
};
SHARED_LAYOUT(WindSource, 56)

SHARED_TABLE(WindTable, WindSource)

/// All that blows at once. Where `counts` is known when a shader is compiled, kinds that do not
/// blow cost nothing.
struct Wind {
    uint counts;       ///< four bits for each kind, from the lowest: how many sources it has
    float eddySize;    ///< [m] > 0 of the eddies where wind meets the ground head-on
    float eddySpeed;   ///< [m/s] at which they travel
    float sum;         ///< [1/s] of all strengths
    WindTable sources; ///< kind after kind
};
SHARED_LAYOUT(Wind, 24)

SHARED_FN uint windCount(uint counts, uint kind)
{
    return (counts >> (4u * kind)) & 15u;
}

/// Height of the travelling wave at a place, in [0, 1]: three sines of unlike direction and length,
/// as in the directional wave of Jahrmann & Wimmer's demo, laid along the wind instead of the x
/// axis.
SHARED_FN float windWaveAt(WindSource source, vec3 position, float time)
{
    const vec3 side = abs(source.direction.y) < 0.99f
                          ? normalize(cross(source.direction, vec3(0.0f, 1.0f, 0.0f)))
                          : vec3(1.0f, 0.0f, 0.0f);
    const float k = 6.2831853f / source.size;
    const float along = k * (dot(position, source.direction) - source.speed * time);
    const float across = k * dot(position, side);
    const float sum = cos(0.9f * along + 0.4f * across) + sin(0.55f * along - 0.25f * across) +
                      sin(0.3f * along + 0.6f * across);
    return 1.0f - max(sum / 3.0f, 0.0f);
}

/// Amount in [0, 2] of the noise that the wind carries along. Level ground cuts a plane out of the
/// lattice: there it is noise in two dimensions, with a grain of `size` along the wind and twice
/// that across. The position is stretched by half across.
SHARED_FN float windNoiseAt(WindSource source, vec3 position, float time)
{
    const vec3 carried = position - source.direction * (source.speed * time);
    const vec3 across = carried - source.direction * dot(carried, source.direction);
    const vec3 stretched = (1.0f / source.size) * (carried - 0.5f * across);
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
    const vec3 across = (position - source.direction * along) / source.size;
    const float bend = 0.8f * (valueNoise(0.7f * across + vec3(5.1f)) - 0.5f);
    // Behind a front the phase grows: what is felt rises first, and then dies away.
    const float phase = (source.speed * time - along) / source.size + bend;
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

/// What a blade with its tip at `tip` heights from its root feels of `flow`: along the ground
/// alone, but for `lift`; and less where the blade lies along it (Jahrmann & Wimmer, section 5.1).
/// A tip of no length feels all.
SHARED_FN vec3 windFelt(WindSource source, vec3 flow, vec3 up, vec3 tip)
{
    const vec3 wind = source.strength * (flow - up * ((1.0f - source.lift) * dot(flow, up)));
    const float square = dot(wind, wind) * dot(tip, tip);
    const float along = square > 1e-12f ? abs(dot(wind, tip)) * inversesqrt(square) : 0.0f;
    return (1.0f - source.alignment * along) * wind;
}

/// Sum over all sources of what a blade with its tip at `tip` feels at `position`; see windFelt().
SHARED_FN vec3 windSum(Wind wind, vec3 position, vec3 up, vec3 tip, float time)
{
    vec3 sum = vec3(0.0f);
    uint next = 0u;
    for (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        const float amount = windNoiseAt(source, position, time);
        sum += windFelt(
            source, windAlong(wind, source, source.direction, amount, position, up, time), up, tip);
    }
    for (uint i = windCount(wind.counts, windTurning); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        const float angle = source.turn * time;
        const vec3 direction =
            source.direction * cos(angle) + cross(up, source.direction) * sin(angle);
        const float amount =
            sin(source.rate * time - (6.2831853f / source.size) * dot(position, source.direction));
        sum += windFelt(source, windAlong(wind, source, direction, amount, position, up, time), up,
                        tip);
    }
    for (uint i = windCount(wind.counts, windWave); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        const float wave = windWaveAt(source, position, time);
        sum += windFelt(source,
                        windAlong(wind, source, source.direction, wave * wave, position, up, time),
                        up, tip);
    }
    for (uint i = windCount(wind.counts, windRadial); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        sum += windFelt(source, windAround(source, position - source.centre, up, time, false), up,
                        tip);
    }
    for (uint i = windCount(wind.counts, windSwirl); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        sum +=
            windFelt(source, windAround(source, position - source.centre, up, time, true), up, tip);
    }
    for (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {
        const WindSource source = wind.sources.at[next++];
        const float amount = windGustAt(source, position, time);
        sum += windFelt(
            source, windAlong(wind, source, source.direction, amount, position, up, time), up, tip);
    }
    return sum;
}

/// The wind at `position` [m] and `time` [s] over ground with unit `up`, in blade heights per
/// second.
SHARED_FN vec3 windAt(Wind wind, vec3 position, vec3 up, float time)
{
    return windSum(wind, position, up, vec3(0.0f), time);
}

/// What of the wind pulls at a blade with its tip at `tip` heights from the root: less the more the
/// blade lies down.
SHARED_FN vec3 windForce(Wind wind, vec3 root, vec3 up, vec3 tip, float time)
{
    return max(dot(tip, up), 0.0f) * windSum(wind, root, up, tip, time);
}

SHARED_END
#endif
