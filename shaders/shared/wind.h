// The wind: one vector for every place and time.
#ifndef SWARD_SHARED_WIND_H
#define SWARD_SHARED_WIND_H

#include "shaders/shared/noise.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Directional wind with waves and gusts that travel along it.
struct Wind {
    vec3 direction;   ///< unit; where it blows to
    float strength;   ///< [1/s] pull on a blade across the wind, in its heights per second
    float waveLength; ///< [m] from crest to crest of the waves
    float speed;      ///< [m/s] at which waves and gusts travel
    float gustSize;   ///< [m] size of gusts along the wind; twice that across
    float gustiness;  ///< [0, 1] share of the strength that comes in gusts
};
SHARED_LAYOUT(Wind, 32)

/// Height of the travelling wave at a place, in [0, 1]: three sines of unlike direction and length,
/// as in the directional wave of Jahrmann & Wimmer's demo, laid along the wind instead of the x
/// axis.
SHARED_FN float windWave(Wind wind, vec3 position, float time)
{
    const vec3 side = abs(wind.direction.y) < 0.99f
                          ? normalize(cross(wind.direction, vec3(0.0f, 1.0f, 0.0f)))
                          : vec3(1.0f, 0.0f, 0.0f);
    const float k = 6.2831853f / wind.waveLength;
    const float along = k * (dot(position, wind.direction) - wind.speed * time);
    const float across = k * dot(position, side);
    const float sum = cos(0.9f * along + 0.4f * across) + sin(0.55f * along - 0.25f * across) +
                      sin(0.3f * along + 0.6f * across);
    return 1.0f - max(sum / 3.0f, 0.0f);
}

/// Wind at `position` [m] and `time` [s], in blade heights per second.
SHARED_FN vec3 windAt(Wind wind, vec3 position, float time)
{
    const float wave = windWave(wind, position, time);
    // Gusts: value noise carried along by the wind, longer across than along.
    const vec3 carried = position - wind.direction * (wind.speed * time);
    const vec3 across = carried - wind.direction * dot(carried, wind.direction);
    const vec3 stretched = (carried - 0.5f * across) / wind.gustSize;
    const float gust =
        0.65f * valueNoise(stretched) + 0.35f * valueNoise(2.7f * stretched + vec3(17.3f));
    const float amount = mix(wave * wave, gust * gust * 2.0f, wind.gustiness);
    return wind.direction * (wind.strength * amount);
}

SHARED_END
#endif
