// Light, air and film: what ground, grass and sky have in common. The including stage has a push
// constant `push` with the frame.
#ifndef SWARD_LIGHTING_GLSL
#define SWARD_LIGHTING_GLSL

#include "shaders/film_curve.glsl"
#include "shaders/shared/debug_mode.h"
#include "shaders/shared/distance_band.h"
#include "shaders/shared/passes.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) FRAME.environment.wind.sources[i]
#endif

#include "shaders/shared/wind.h"

/// Known when the pipeline is made, see debugAsTold.
layout(constant_id = 0) const uint knownDebugMode = debugAsTold;
const bool paintsWind = knownDebugMode == debugWind;

/// To whom the picture goes: 0 to Sward's own film, 1 to a host's as it is, 2 to a host's own film,
/// 3 to nobody, who wants depth alone.
layout(constant_id = 9) const uint handedTo = 0u;
const uint handedToFilm = 0u;
const uint handedToHostFilm = 2u;
const uint handedToNobody = 3u;

/// Of the frame.
uint debugMode()
{
    return knownDebugMode == debugAsTold ? FRAME.debugMode : knownDebugMode;
}

/// Whether the picture shows nothing but how much grass covers, by distance.
bool showsBands()
{
    return debugMode() >= debugNear;
}

float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

/// Linear colour of an sRGB-encoded one (IEC 61966-2-1).
vec3 decodeSrgb(vec3 c)
{
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

/// Radiance of the sky near the horizon in a direction with that cosine from the sun's.
vec3 paleSky(float sunCosine)
{
    // Paler and warmer through more air.
    const float towards = 0.5 + 0.5 * sunCosine;
    return FRAME.skyColor * mix(vec3(1.12, 1.02, 0.90), vec3(2.30, 1.30, 0.60),
                                FRAME.lowSun * towards * towards);
}

/// Light scattered forward around the sun.
vec3 glowAround(float sunCosine)
{
    const float toSun = max(sunCosine, 0.0);
    const float glow = 0.10 * pow(toSun, 4.0) + 0.22 * pow(toSun, 32.0) + 0.5 * pow(toSun, 400.0);
    return glow * FRAME.sunColor * mix(vec3(0.36, 0.34, 0.31), vec3(0.45, 0.33, 0.22), FRAME.lowSun);
}

/// Radiance of the sky towards a unit ray, without sun and clouds: deep above, pale at the horizon,
/// warm on the side of a low sun. `height`, not negative, and `sunCosine`: of the ray along the sky's
/// up-vector and towards the sun.
vec3 skyAbove(float height, float sunCosine)
{
    const vec3 zenith = FRAME.skyColor * vec3(0.15, 0.30, 0.56);
    return mix(paleSky(sunCosine), zenith, 1.0 - exp(-4.0 * height)) + glowAround(sunCosine);
}

/// The same of any unit ray: below the horizon there is haze, as over water and far land.
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

/// Diffuse light from sky and ground on a surface with unit normal `n`. The whole sky is a quarter
/// brighter than straight above: paler lower down, and bright around the sun.
vec3 hemisphere(vec3 n)
{
    return mix(FRAME.groundColor, 1.25 * FRAME.skyColor, 0.5 + 0.5 * dot(n, FRAME.skyUp));
}

/// What leaves around throw on and let through, below `leafArea` of them: of the sun's light, with
/// the sun at this cosine from the ground's normal and this share of it seen, and of the sky's. A
/// leaf passes on a fifth of the green and less of other colours, half of that downwards, and the
/// leaves below it take their share. Nothing without grass.
vec3 lightAmongLeaves(float leafArea, float cosine, float sunShare)
{
    const vec3 passedOn = vec3(0.17, 0.20, 0.06);
    const vec3 caught = FRAME.sunColor * (max(cosine, 0.0) * sunShare * (1.0 - sunBelow(leafArea, cosine))) +
                        1.25 * FRAME.skyColor * (1.0 - skyBelow(leafArea));
    return passedOn * caught * exp(-0.5 * leafExtinction * leafArea);
}

/// Share of the light that passes so much air [m], which thins with height; `climb`: the cosine of the
/// way from the eye with the sky's up-vector.
float clearBetween(float climb, float distance)
{
    const float rise = FRAME.fogFalloff * distance * climb;
    // Mean of exp(−height) along the ray.
    const float mean = abs(rise) > 1e-3 ? (1.0 - exp(-rise)) / rise : 1.0 - 0.5 * rise;
    return exp(-FRAME.fogDensity * distance * mean);
}

/// Puts air between the eye and something `distance` [m] away in a unit direction.
vec3 throughAir(vec3 color, vec3 direction, float distance)
{
    const float climb = dot(direction, FRAME.skyUp);
    // The air is as bright as the sky just above the horizon behind it: towards
    // direction − (climb − 0.02) · skyUp, which is so long.
    const float perLength = inversesqrt(max(1.0 - climb * climb, 0.0) + 0.02 * 0.02);
    const float sunCosine = dot(direction, FRAME.sunDirection) -
                            (climb - 0.02) * dot(FRAME.skyUp, FRAME.sunDirection);
    return mix(skyAbove(0.02 * perLength, sunCosine * perLength), color, clearBetween(climb, distance));
}

/// From radiance to the picture, if that is not left to a host.
vec3 develop(vec3 radiance)
{
    if (handedTo == handedToHostFilm)
        return radiance * FRAME.exposure;
    return filmOf(radiance * FRAME.exposure);
}

/// How soft a picture with several samples is where grass stands so far away [m] and covers this
/// share of the ground: 1 where blades are thinner than 0.6 pixels, 0 where they are wider than 1.5,
/// or are drawn as narrow as they are. It stands in the alpha channel, as 1 − softness.
float softness(float distance, float share)
{
    if (FRAME.view.minWidth <= 0.0 || debugMode() != debugNothing)
        return 0.0;
    const float widthPixels = FRAME.view.lodWidth * FRAME.view.pixelsPerUnit / max(distance, 1e-6);
    return share * (1.0 - smoothstep(0.6, 1.5, widthPixels));
}

/// Half a step of an 8-bit picture up or down, by the place alone, so that smooth gradients show no
/// bands. `color` is linear; a step of its sRGB form is 2.2·color^(6/11) wide.
vec3 dithered(vec3 color, vec2 place)
{
    const uint h = mixUint(uint(place.x) + 65536u * uint(place.y));
    const float noise = float(h >> 8u) * (1.0 / 16777215.0) - 0.5;
    return color + noise * (2.2 / 255.0) * pow(max(color, 0.0), vec3(0.5454));
}

/// A colour for a number, well spread, for the debug pictures.
vec3 colorOf(uint number)
{
    const uint h = mixUint(number * 2654435761u + 12345u);
    return 0.15 + 0.85 * vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

/// The wind's speed at a place as a colour: dark blue where it is calm, over green to white.
vec3 colorOfWind(vec3 position, vec3 up)
{
    const vec3 wind = windAt(FRAME.environment.wind, position, up, FRAME.time);
    const float speed = clamp(length(wind) / max(FRAME.environment.wind.sum, 1e-6), 0.0, 1.0);
    return mix(mix(vec3(0.01, 0.03, 0.20), vec3(0.02, 0.45, 0.15), smoothstep(0.0, 0.45, speed)),
               vec3(1.0, 0.95, 0.8), smoothstep(0.35, 1.0, speed));
}

/// Share of the tip's colour in that of a blade `along` [0, 1] its height.
float tipShareAt(float along)
{
    return smoothstep(-0.15, 0.8, along);
}

#endif
