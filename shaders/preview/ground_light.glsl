// The light of the ground, shared by all drawing paths. AFTER_BLADES is defined where blades have moved, and have cast
// their shadows, before the ground is lit: not by the graphics pipeline.
#ifndef SWARD_PREVIEW_GROUND_LIGHT_GLSL
#define SWARD_PREVIEW_GROUND_LIGHT_GLSL

#include "shaders/common/lighting.glsl"
#include "shaders/shared/ground.h"
#include "shaders/shared/look/ground_detail.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/visibility.h"

/// A place of the ground.
struct GroundPoint {
    vec3 position; ///< [m] relative to the field's origin
    vec3 normal;   ///< of any length
    vec3 albedo;   ///< linear, without the litter on it
    bool isDoubleSided;
};

/// Relief of the ground, from noise in space: no direction is stretched, on any slope. Has all sizes that a pixel of
/// `pixel` [m] can show.
struct Relief {
    float brightness; ///< relative to the ground's colour, 1 on average
    vec3 slope;       ///< derivative of the height
};

/// Adds noise of one `size` [m], scaled along each axis by `stretch`.
void addNoise(inout Relief relief, vec3 position, vec3 stretch, float size, float amount)
{
    const vec4 noise = valueNoiseSlope(position * stretch / size);
    relief.brightness += amount * (noise.w - 0.5);
    relief.slope += (0.5 * amount) * (noise.xyz * stretch);
}

/// Grains and crumbs, from `size` [m] down.
Relief crumbs(vec3 position, float size, float pixel)
{
    Relief relief = Relief(1.0, vec3(0.0));
    for (uint octave = 0u; octave < 4u; ++octave) {
        const float shown = shownAt(size, pixel);
        if (shown <= 0.0)
            break;
        addNoise(relief, position + 17.0 * float(octave) * size, vec3(1.0), size, 0.4 * shown);
        size *= 0.37;
    }
    return relief;
}

/// Strands of litter and moss, which cross in three directions.
Relief strands(vec3 position, float size, float pixel)
{
    Relief relief = Relief(1.0, vec3(0.0));
    const float thin = 0.12 * size;
    const float shown = shownAt(thin, pixel);
    if (shown > 0.0) {
        const mat3 turned = mat3(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
        Relief turnedRelief = Relief(1.0, vec3(0.0));
        addNoise(relief, position, vec3(0.15, 1.0, 1.0), thin, 0.45 * shown);
        addNoise(relief, position, vec3(1.0, 1.0, 0.15), thin, 0.45 * shown);
        addNoise(turnedRelief, turned * position, vec3(0.15, 1.0, 1.0), thin, 0.45 * shown);
        relief.brightness += turnedRelief.brightness - 1.0;
        relief.slope += turnedRelief.slope * turned;
    }
    return relief;
}

/// Size of the largest crumbs of ground without any grass [m].
const float bareStructure = 0.32;

/// Share of undergrowth that hides the detail of bare ground.
const float hiddenBelow = 0.93;

/// Smallest difference between places this far from the field's origin, relative to the distance: two steps of a float.
const float placeStep = 2.5e-7;

/// Slope of crumbs in a light from the horizon, at most, as a share of that light.
const float darkestCrumb = 0.85;

/// The film colour of the ground, and 1 − softness.
vec4 groundPicture(GroundPoint point)
{
    const vec3 ray = FRAME.view.eye - point.position;
    const float distance = length(ray);
    const vec3 toEye = ray / max(distance, 1e-6);
    vec3 n = normalize(point.normal);
    if (point.isDoubleSided && dot(n, toEye) < 0.0)
        n = -n;

    // The surrounding grass absorbs its share of the light, up to the draw distance.
    const float farthest = FRAME.cover.farthest;
    const float grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance);
    const vec3 grass = grassAt(FRAME.cover, point.position);
    const float blades = grass.x * grown;
    const float leafArea = FRAME.cover.thinned * blades;
    const vec3 far = abs(point.position);
    const float pixel = max(distance / FRAME.view.pixelsPerUnit, placeStep * max(far.x, max(far.y, far.z)));
    const float size = FRAME.cover.structure > 0.0 ? FRAME.cover.structure : bareStructure;
    // Undergrowth ends in tufts, except on turf; the grid of the leaf area is coarser.
    const float closed = undergrowthBelow(leafArea);
    const float ragged = mix(raggedShare(closed, point.position, 1.0 / max(FRAME.cover.cellsPerMetre, 1e-6), size, pixel),
                             closed, turfIn(point.albedo));
    const float under = FRAME.cover.thatch * ragged;

    vec3 albedo = point.albedo;
    vec3 shade = vec3(1.0);
    float brightness = 1.0 - under;
    vec3 rough = vec3(0.0);
    vec3 crumbled = vec3(0.0);
    if (under < hiddenBelow) {
        const GroundDetail detail = groundDetail(point.position, n, FRAME.skyUp, albedo, size, pixel);
        albedo = detail.albedo;
        brightness *= detail.brightness;
        crumbled = (1.0 - under) * (detail.slope - n * dot(n, detail.slope));
    }
    if (under > 0.0) {
        Relief relief = crumbs(point.position, size, pixel);
        const Relief litter = strands(point.position, size, pixel);
        brightness += under * max(relief.brightness * litter.brightness, 0.2);
        rough = under * (relief.slope + litter.slope);
        shade = meadowShade(point.position, toneOf(grass));
        albedo = mix(albedo, shade * FRAME.cover.undergrowth, under);
    }
    n = normalize(n - (rough - n * dot(n, rough)));
    // Crumbs take from one side what they give to the other, so that their mean is that of even ground.
    const float even = max(dot(n, FRAME.sunDirection), 0.0);
    const float turned = dot(crumbled, FRAME.sunDirection) / max(even, 0.3);
    const float facing = even * (1.0 - clamp(turned, -darkestCrumb, darkestCrumb));
    const float seen = even > 0.0 ? sunSeen(FRAME.shadow, point.position, n) : 0.0;
    float below = sunBelow(leafProjectionOf(FRAME.cover), leafArea, even);
#ifdef AFTER_BLADES
    const vec2 among = sunAmongBlades(FRAME.bladeShadow, point.position, noBladeSeed);
    below = mix(below, among.x, among.y);
#endif
    const vec3 light = hemisphere(normalize(n - crumbled)) * skyBelow(leafArea) +
                       lightAmongLeaves(leafArea, 0.0, even, seen * FRAME.sunColor, 1.25 * FRAME.skyColor,
                                        1.5 * FRAME.cover.sward) +
                       FRAME.sunColor * (facing * seen * below);
    vec3 color = brightness * albedo * light;
    const float sward = closed > 0.0 ? swardShare(FRAME.cover, leafArea, FRAME.cover.thinned * leavesPerDrawn(FRAME.view, distance)) * (ragged / closed) : 0.0;
    if (sward > 0.0) {
        const vec3 open = hemisphere(n) + FRAME.sunColor * (even * seen);
        color = mix(color, brightness * swardBrightness(max(dot(n, toEye), 0.0)) * shade * FRAME.cover.sward * open, sward);
    }
    if (debugMode() != debugNothing)
        color = showsBands() ? vec3(0.0) : vec3(0.35) * (0.5 + 0.5 * even);
    else
        color = throughAir(color, -toEye, distance);
    if (paintsWind)
        color = colorOfWind(point.position, n);
    // Among grass the ground is as soft as the blades on it.
    return vec4(develop(color), 1.0 - softness(distance, min(blades, 1.0)));
}

#endif
