// Light, air and film, shared by ground, grass and sky. The including stage has a push constant `push` with the frame.
#ifndef SWARD_COMMON_LIGHTING_GLSL
#define SWARD_COMMON_LIGHTING_GLSL

#include "shaders/common/output_mode.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/distance_band.h"
#include "shaders/shared/look/blade_colors.h"
#include "shaders/shared/look/film_curve.h"
#include "shaders/shared/passes.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) FRAME.environment.wind.sources[i]
#define WIND_PHASE(wind, i) FRAME.environment.wind.phases[i]
#define WIND_LATTICE(wind) FRAME.environment.wind.lattice
#endif

#include "shaders/shared/wind.h"

/// Known at pipeline creation, see debugAsTold.
layout(constant_id = idKnownDebugMode) const uint knownDebugMode = debugAsTold;
const bool paintsWind = knownDebugMode == debugWind;

/// The debug mode of the frame.
uint debugMode()
{
    return knownDebugMode == debugAsTold ? FRAME.debugMode : knownDebugMode;
}

/// Whether the picture shows only the share that grass covers, by distance.
bool showsBands()
{
    return debugMode() >= debugNear;
}

float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

/// Radiance of the sky near the horizon in a direction with this cosine to the sun's direction.
vec3 paleSky(float sunCosine)
{
    // Paler and warmer where light passes through more air; of a low sun on all sides, and most on the sun's.
    const float towards = 0.5 + 0.5 * sunCosine;
    const vec3 pale = mix(vec3(1.12, 1.02, 0.90), vec3(1.36, 1.12, 0.96), FRAME.lowSun);
    return FRAME.skyColor * mix(pale, vec3(2.50, 1.45, 0.66), FRAME.lowSun * towards * towards);
}

/// Light scattered forward around the sun.
vec3 glowAround(float sunCosine)
{
    const float toSun = max(sunCosine, 0.0);
    const float glow = 0.10 * pow(toSun, 4.0) + 0.22 * pow(toSun, 32.0) + 0.5 * pow(toSun, 400.0);
    return glow * FRAME.sunColor * mix(vec3(0.36, 0.34, 0.31), vec3(0.45, 0.33, 0.22), FRAME.lowSun);
}

/// Radiance of the sky towards a unit ray, without sun and clouds: deep above, pale at the horizon, warm on the side of
/// a low sun. `height` (not negative) is the ray's component along the sky's up-vector, `sunCosine` that towards the
/// sun.
vec3 skyAbove(float height, float sunCosine)
{
    const vec3 zenith = FRAME.skyColor * vec3(0.15, 0.30, 0.56);
    return mix(paleSky(sunCosine), zenith, 1.0 - exp(-4.0 * height)) + glowAround(sunCosine);
}

/// The same for any unit ray. Below the horizon there is haze, as over water and far land.
vec3 skyRadiance(vec3 ray)
{
    const float height = dot(ray, FRAME.skyUp);
    const float sunCosine = dot(ray, FRAME.sunDirection);
    if (height >= 0.0)
        return skyAbove(height, sunCosine);
    const vec3 pale = paleSky(sunCosine);
    const vec3 haze = mix(0.85 * pale, FRAME.groundColor, 0.2);
    return mix(pale, haze, 1.0 - exp(2.2 * height)) + glowAround(sunCosine);
}

/// Diffuse light from sky and ground on a surface with unit normal `n`. The mean sky is a quarter brighter than the
/// zenith: paler lower down, and bright around the sun.
vec3 hemisphere(vec3 n)
{
    return mix(FRAME.groundColor, 1.25 * FRAME.skyColor, 0.5 + 0.5 * dot(n, FRAME.skyUp));
}

/// Share of the light from a leaf that meets another one.
const float passedAgain = 0.5;

/// Light of sun and sky that leaves around a place pass on to it, both sides of a leaf together. The place is below
/// `leafArea` of leaves; `below`: 1 if there are leaves below it as well, 0 on the ground. `sun` is at `cosine` to the
/// ground's normal, `sky` is the diffuse light from above; `leaf` is the colour that a leaf reflects and lets through.
/// A leaf at depth Λ gets sunBelow(Λ) of the sun times its projection (leafProjectionAlong), and skyBelow(Λ) of the sky.
/// Leaves above fill 1 − skyBelow(leafArea) of the upper hemisphere, leaves below all of the lower one; both are seen with
/// skyExtinction. Light that leaves pass on several times is a geometric
/// series. docs/algorithms/shading.md; zero without grass.
vec3 lightAmongLeaves(float leafArea, float below, float cosine, vec3 sun, vec3 sky, vec3 leaf)
{
    const float risen = max(cosine, lowestSun);
    const float crossed = leafProjectionAlong(leafProjectionOf(FRAME.cover), risen) / risen;
    const float left = exp(-crossed * leafArea);
    const float open = skyBelow(leafArea);
    // Means over the leaves above.
    const float leftAbove = leafArea > 1e-3 ? (1.0 - left) / (crossed * leafArea) : 1.0;
    const float openAbove = leafArea > 1e-3 ? (1.0 - open) / (skyExtinction * leafArea) : 1.0;
    const float leaves = 1.0 - open;
    const float sunOfLeaves = leaves * leftAbove + below * left / (1.0 + crossed / skyExtinction);
    const float skyOfLeaves = leaves * openAbove + below * open * 0.5;
    const vec3 once = 0.25 * leaf * (sun * (crossed * risen * sunOfLeaves) + sky * skyOfLeaves);
    return once / (1.0 - passedAgain * leaf);
}

/// Share of the light that passes `distance` [m] of air, which thins with height. `climb`: cosine between the ray from
/// the eye and the sky's up-vector.
float clearBetween(float climb, float distance)
{
    const float rise = FRAME.fogFalloff * distance * climb;
    // Mean of exp(−height) along the ray.
    const float mean = abs(rise) > 1e-3 ? (1.0 - exp(-rise)) / rise : 1.0 - 0.5 * rise;
    return exp(-FRAME.fogDensity * distance * mean);
}

/// Applies the air between the eye and a point `distance` [m] away in a unit direction.
vec3 throughAir(vec3 color, vec3 direction, float distance)
{
    const float climb = dot(direction, FRAME.skyUp);
    // The air is as bright as the sky just above the horizon behind it: towards direction − (climb − 0.02) · skyUp,
    // whose length is 1 / perLength.
    const float perLength = inversesqrt(max(1.0 - climb * climb, 0.0) + 0.02 * 0.02);
    const float sunCosine = dot(direction, FRAME.sunDirection) -
                            (climb - 0.02) * dot(FRAME.skyUp, FRAME.sunDirection);
    return mix(skyAbove(0.02 * perLength, sunCosine * perLength), color, clearBetween(climb, distance));
}

/// Converts radiance to the picture, unless a host does so.
vec3 develop(vec3 radiance)
{
    if (outputMode == outputRadiance)
        return radiance * FRAME.exposure;
    return filmOf(radiance * FRAME.exposure);
}

/// Softness of a multisampled picture where grass at `distance` [m] covers `share` of the ground. 1 where blades are
/// thinner than 0.6 pixels; 0 where they are wider than 1.5 or have no minimum width. The alpha channel stores 1 −
/// softness.
float softness(float distance, float share)
{
    if (FRAME.view.minWidth <= 0.0 || debugMode() != debugNothing)
        return 0.0;
    const float widthPixels = FRAME.view.lodWidth * FRAME.view.pixelsPerUnit / max(distance, 1e-6);
    return share * (1.0 - smoothstep(0.6, 1.5, widthPixels));
}

/// Adds up to half a step of an 8-bit picture, as a function of the place alone, against banding in smooth gradients;
/// radiance stays as it is. `color` is linear; a step of its sRGB form is 2.2·color^(6/11) wide.
vec3 dithered(vec3 color, vec2 place)
{
    if (outputMode == outputRadiance)
        return color;
    const uint h = mixUint(uint(place.x) + 65536u * uint(place.y));
    const float noise = float(h >> 8u) * (1.0 / 16777215.0) - 0.5;
    return color + noise * (2.2 / 255.0) * pow(max(color, 0.0), vec3(0.5454));
}

/// A well distributed colour for a number, for debug pictures.
vec3 colorOf(uint number)
{
    const uint h = mixUint(number * 2654435761u + 12345u);
    return 0.15 + 0.85 * vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

/// The wind's speed at a place as a colour: dark blue for calm, over green to white.
vec3 colorOfWind(vec3 position, vec3 up)
{
    const vec3 wind = windAt(FRAME.environment.wind, position, up, 0.0);
    const float speed = clamp(length(wind) / max(FRAME.environment.wind.sum, 1e-6), 0.0, 1.0);
    return mix(mix(vec3(0.01, 0.03, 0.20), vec3(0.02, 0.45, 0.15), smoothstep(0.0, 0.45, speed)),
               vec3(1.0, 0.95, 0.8), smoothstep(0.35, 1.0, speed));
}

#endif
