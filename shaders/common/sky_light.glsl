// The film colour of the sky, shared by all drawing paths.
#ifndef SWARD_COMMON_SKY_LIGHT_GLSL
#define SWARD_COMMON_SKY_LIGHT_GLSL

#include "shaders/common/lighting.glsl"
#include "shaders/shared/noise.h"

/// Thickness of the clouds at a place of their layer, 0 where there is none.
float cloudAt(vec3 place)
{
    // Octaves of noise; finer octaves are stretched along the wind. Half of the places exceed 0.48.
    const float least = mix(0.72, 0.34, FRAME.clouds);
    const float finest = 1.0 / 32.0;
    float sum = 0.0;
    float weight = 0.5;
    for (uint octave = 0u; octave < 5u; ++octave) {
        sum += weight * valueNoise(place);
        // The remaining octaves sum to less than this octave's maximum, by the finest octave's weight.
        if (sum + weight - finest <= least)
            return 0.0;
        place = 2.13 * place.yzx + vec3(3.7, 11.1, 5.3);
        weight *= 0.5;
    }
    return smoothstep(0.0, 0.26, sum - least);
}

/// Fair-weather clouds in front of `color`: a layer in perspective that fades into the haze.
vec3 withClouds(vec3 color, vec3 ray)
{
    const float height = dot(ray, FRAME.skyUp);
    if (FRAME.clouds <= 0.0 || height <= 0.0)
        return color;
    const vec3 place = ray * (1.9 / (height + 0.16));
    const float thickness = cloudAt(place);
    if (thickness <= 0.0)
        return color;
    // Clouds between here and the sun absorb light.
    const vec3 sunwards = FRAME.sunDirection - FRAME.skyUp * dot(FRAME.sunDirection, FRAME.skyUp);
    const float shade = cloudAt(place + 0.35 * sunwards);
    const float toSun = max(dot(ray, FRAME.sunDirection), 0.0);
    const vec3 lit = FRAME.sunColor * (0.30 * exp(-1.4 * shade) * (1.0 + 0.9 * pow(toSun, 6.0))) +
                     0.55 * FRAME.skyColor;
    const float shown = thickness * 0.85 * smoothstep(0.0, 0.22, height);
    return mix(color, lit, shown);
}

/// The sky with its sun towards unit `ray`, at `place` [pixels] of the picture.
vec3 skyPicture(vec3 ray, vec2 place)
{
    if (debugMode() != debugNothing)
        return showsBands() ? vec3(0.0) : dithered(develop(vec3(0.6)), place);
    vec3 color = withClouds(skyRadiance(ray), ray);
    // The sun's disc is half a degree wide; its soft rim is slightly wider.
    const float toSun = dot(ray, FRAME.sunDirection);
    color += FRAME.sunColor * 6.0 * smoothstep(0.99985, 0.99997, toSun);
    return dithered(develop(color), place);
}

#endif
