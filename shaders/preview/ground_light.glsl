// The light of the ground, shared by all drawing paths.
#ifndef SWARD_GROUND_LIGHT_GLSL
#define SWARD_GROUND_LIGHT_GLSL

#include "shaders/lighting.glsl"
#include "shaders/shared/ground.h"
#include "shaders/shared/noise.h"

/// A place of the ground.
struct GroundPoint {
    vec3 position; ///< [m] relative to the field's origin
    vec3 normal;   ///< of any length
    vec3 albedo;   ///< linear, without the litter on it
    bool isDoubleSided;
};

/// Grains and crumbs of the ground: the brightness relative to the ground's colour, 1 on average. Uses all sizes that a
/// pixel of the picture can show.
float grain(vec3 position, float pixel)
{
    float sum = 0.0;
    float size = 0.32; // [m]
    for (uint octave = 0u; octave < 4u; ++octave) {
        const float shown = clamp(0.35 * size / pixel - 1.0, 0.0, 1.0);
        if (shown <= 0.0)
            break;
        sum += shown * (valueNoise(position / size + 17.0 * float(octave)) - 0.5);
        size *= 0.37;
    }
    return 1.0 + 0.4 * sum;
}

/// Colour of fallen leaves of last year, and of stems of this year.
const vec3 litterColor = vec3(0.135, 0.120, 0.048);

/// The film colour of the ground, and 1 − softness.
vec4 groundPicture(GroundPoint point)
{
    const vec3 ray = FRAME.view.eye - point.position;
    const float distance = length(ray);
    const vec3 toEye = ray / max(distance, 1e-6);
    vec3 n = normalize(point.normal);
    if (point.isDoubleSided && dot(n, toEye) < 0.0)
        n = -n;

    const float facing = max(dot(n, FRAME.sunDirection), 0.0);
    // The surrounding grass absorbs its share of the light, up to the draw distance.
    const float farthest = FRAME.cover.farthest;
    const float grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance);
    const float leafArea = leafAreaAt(FRAME.cover, point.position) * grown;
    const vec3 albedo = mix(point.albedo, litterColor, 0.8 * (1.0 - exp(-0.7 * leafArea))) * grain(point.position, distance / FRAME.view.pixelsPerUnit);
    const float seen = facing > 0.0 ? sunSeen(FRAME.shadow, point.position, n) : 0.0;
    const vec3 light = hemisphere(n) * skyBelow(leafArea) +
                       lightAmongLeaves(leafArea, facing, seen, FRAME.sunColor, 1.25 * FRAME.skyColor) +
                       FRAME.sunColor * (facing * seen * sunBelow(leafArea, facing));
    vec3 color = albedo * light;
    if (debugMode() != debugNothing)
        color = showsBands() ? vec3(0.0) : vec3(0.35) * (0.5 + 0.5 * facing);
    else
        color = throughAir(color, -toEye, distance);
    if (paintsWind)
        color = colorOfWind(point.position, n);
    // Among grass the ground is as soft as the blades on it.
    return vec4(develop(color), 1.0 - softness(distance, min(leafArea, 1.0)));
}

#endif
