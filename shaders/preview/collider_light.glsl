// The light of a ball or capsule, shared by all drawing paths.
#ifndef SWARD_PREVIEW_COLLIDER_LIGHT_GLSL
#define SWARD_PREVIEW_COLLIDER_LIGHT_GLSL

#include "shaders/common/lighting.glsl"

/// Painted wood, in a red that grass does not have.
const vec3 paint = vec3(0.52, 0.075, 0.035);

/// The film colour of a place of a collider.
vec4 colliderPicture(vec3 position, vec3 normal)
{
    const vec3 n = normalize(normal);
    const vec3 ray = FRAME.view.eye - position;
    const float distance = length(ray);
    const vec3 toEye = ray / max(distance, 1e-6);
    const float facing = max(dot(n, FRAME.sunDirection), 0.0);
    const float sunlit = facing > 0.0 ? facing * sunSeen(FRAME.shadow, position, n) : 0.0;
    vec3 color = paint * (hemisphere(n) + FRAME.sunColor * sunlit);

    // Varnish: a mirrored sky with Schlick's Fresnel term, and the sun's soft highlight.
    const float edge = 0.04 + 0.96 * pow(1.0 - max(dot(n, toEye), 0.0), 5.0);
    const vec3 mirrored = reflect(-toEye, n);
    const float above = smoothstep(-0.1, 0.2, dot(mirrored, FRAME.skyUp));
    color += edge * mix(0.3 * FRAME.groundColor, skyRadiance(mirrored), above);
    const float spot = pow(max(dot(n, normalize(FRAME.sunDirection + toEye)), 0.0), 220.0);
    color += FRAME.sunColor * (0.5 * spot * sunlit);

    if (debugMode() != debugNothing)
        color = showsBands() ? vec3(0.0) : vec3(0.5) * (0.5 + 0.5 * facing);
    else
        color = throughAir(color, -toEye, distance);
    return vec4(develop(color), 1.0);
}

#endif
