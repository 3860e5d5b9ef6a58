// Light, air and film: what ground, grass and sky have in common. The including stage has a push
// constant `push` with the frame.
#ifndef SWARD_LIGHTING_GLSL
#define SWARD_LIGHTING_GLSL

#include "shaders/shared/debug_mode.h"
#include "shaders/shared/distance_band.h"
#include "shaders/shared/passes.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) FRAME.nature.wind.sources[i]
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

/// Radiance of the sky towards unit `ray`, without sun and clouds: deep above, pale at the horizon,
/// warm on the side of a low sun, and below the horizon the haze over far land.
vec3 skyRadiance(vec3 ray)
{
    const float height = dot(ray, FRAME.skyUp);
    const float toSun = max(dot(ray, FRAME.sunDirection), 0.0);
    const float low = 1.0 - smoothstep(0.0, 0.6, dot(FRAME.sunDirection, FRAME.skyUp));

    // Paler and warmer through more air; below the horizon haze, as over water.
    const float towards = 0.5 + 0.5 * dot(ray, FRAME.sunDirection);
    const vec3 zenith = FRAME.skyColor * vec3(0.15, 0.30, 0.56);
    const vec3 pale = FRAME.skyColor * mix(vec3(1.12, 1.02, 0.90), vec3(2.30, 1.30, 0.60),
                                           low * towards * towards);
    vec3 color = mix(pale, zenith, 1.0 - exp(-4.0 * max(height, 0.0)));
    const vec3 haze = mix(0.85 * pale, FRAME.groundColor, 0.2);
    color = mix(color, haze, 1.0 - exp(-2.2 * max(-height, 0.0)));

    // Light scattered forward around the sun.
    const float glow = 0.10 * pow(toSun, 4.0) + 0.22 * pow(toSun, 32.0) + 0.5 * pow(toSun, 400.0);
    return color + glow * FRAME.sunColor * mix(vec3(0.36, 0.34, 0.31), vec3(0.45, 0.33, 0.22), low);
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

/// Share of the light that passes the air from the eye to `position`; the air thins with height.
float clearBetween(vec3 position)
{
    const vec3 ray = position - FRAME.view.eye;
    const float eye = FRAME.fogFalloff * (dot(FRAME.view.eye, FRAME.skyUp) - FRAME.fogBase);
    const float rise = FRAME.fogFalloff * dot(ray, FRAME.skyUp);
    // Mean of exp(−height) along the ray.
    const float mean = abs(rise) > 1e-3 ? (1.0 - exp(-rise)) / rise : 1.0 - 0.5 * rise;
    return exp(-FRAME.fogDensity * length(ray) * exp(-eye) * mean);
}

/// Puts air between the eye and something `position` (relative to the field's origin).
vec3 throughAir(vec3 color, vec3 position)
{
    const vec3 ray = position - FRAME.view.eye;
    const float clear = clearBetween(position);
    // The air is as bright as the sky just above the horizon behind it.
    const vec3 direction = ray / max(length(ray), 1e-6);
    const vec3 level = direction - FRAME.skyUp * (dot(direction, FRAME.skyUp) - 0.02);
    return mix(skyRadiance(normalize(level)), color, clear);
}

/// From radiance to the picture: the filmic curve fitted to ACES by K. Narkowicz ("ACES Filmic Tone
/// Mapping Curve", 2015), a little desaturated where it is bright.
vec3 develop(vec3 radiance)
{
    if (handedTo == handedToHostFilm)
        return radiance * FRAME.exposure;
    const vec3 x = radiance * FRAME.exposure * 0.80;
    const vec3 film = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    return clamp(film, 0.0, 1.0);
}

/// How soft a picture with several samples is where grass stands so far away [m] and covers this
/// share of the ground: 1 where blades are thinner than 0.6 pixels, 0 where they are wider than 1.5,
/// or are drawn as narrow as they are. It stands in the alpha channel, as 1 − softness.
float softness(float distance, float share)
{
    if (FRAME.view.leastWidth <= 0.0 || debugMode() != debugNothing)
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
    const vec3 wind = windAt(FRAME.nature.wind, position, up, FRAME.time);
    const float speed = clamp(length(wind) / max(FRAME.nature.wind.sum, 1e-6), 0.0, 1.0);
    return mix(mix(vec3(0.01, 0.03, 0.20), vec3(0.02, 0.45, 0.15), smoothstep(0.0, 0.45, speed)),
               vec3(1.0, 0.95, 0.8), smoothstep(0.35, 1.0, speed));
}

/// Share of the tip's colour in that of a blade `along` [0, 1] its height.
float tipShareAt(float along)
{
    return smoothstep(-0.15, 0.8, along);
}

#endif
