// The film colour of the sky and of the floor below the ground, shared by all drawing paths.
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

/// Colour of the floor, grey as trodden earth: lit, it is about as bright as the haze.
const vec3 floorAlbedo = vec3(0.160, 0.152, 0.130);

/// Share of the sun's light that floor and ground around pass on to a place in shadow.
const float floorBounce = 0.12;

/// sunSeen() of a place of the floor, which may be farther from the sun than the shadow map's box. Nothing there casts
/// shadows: the place is moved to the box along the sun's ray, where the map's empty pixels are behind it.
float sunOnFloor(vec3 place)
{
    if (FRAME.shadow.size == 0u)
        return 1.0;
    const float depth = dot(FRAME.shadow.depth, vec4(place, 1.0));
    const float perMetre = dot(FRAME.shadow.depth.xyz, FRAME.sunDirection);
    return sunSeen(FRAME.shadow, place + FRAME.sunDirection * (max(0.002 - depth, 0.0) / perMetre), FRAME.skyUp);
}

/// What is below the horizon, seen from the eye along unit `ray`; `color` is the haze. Ground that stands on a floor has
/// one: lit by the sun past the ground's shadow map, and by what the ground leaves of the sky, fading into the haze. Other
/// ground floats; there the haze darkens downwards.
vec3 belowHorizon(vec3 color, vec3 ray)
{
    const float climb = dot(ray, FRAME.skyUp);
    if (climb >= 0.0)
        return color;
    const FloorPlane plane = FRAME.floorPlane;
    if (plane.reach <= 0.0)
        return color * (1.0 - 0.35 * smoothstep(0.0, 1.0, -climb));
    const float distance = dot(plane.middle - FRAME.view.eye, FRAME.skyUp) / climb;
    if (distance <= 0.0)
        return color;
    const vec3 place = FRAME.view.eye + distance * ray;
    const float away = distanceFromFootprint(plane, place, cross(FRAME.skyUp, plane.along));
    const float shown = exp(-away / plane.reach);
    if (shown < 0.002)
        return color;
    const float facing = max(dot(FRAME.sunDirection, FRAME.skyUp), 0.0);
    const float lit = facing > 0.0 ? sunOnFloor(place) : 0.0;
    const float open = skyBesideWall(plane.height, away);
    const vec3 light = hemisphere(FRAME.skyUp) * open + FRAME.sunColor * (facing * mix(floorBounce * open, 1.0, lit));
    return mix(color, throughAir(floorAlbedo * light, ray, distance), shown);
}

/// The sky with its sun towards unit `ray`, at `place` [pixels] of the picture.
vec3 skyPicture(vec3 ray, vec2 place)
{
    if (debugMode() != debugNothing)
        return showsBands() ? vec3(0.0) : dithered(develop(vec3(0.6)), place);
    vec3 color = belowHorizon(withClouds(skyRadiance(ray), ray), ray);
    // The sun's disc is half a degree wide; its soft rim is slightly wider.
    const float toSun = dot(ray, FRAME.sunDirection);
    color += FRAME.sunColor * 6.0 * smoothstep(0.99985, 0.99997, toSun);
    return dithered(develop(color), place);
}

#endif
