#version 460
#extension GL_GOOGLE_include_directive : require
// The light of a ball or capsule.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/lighting.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;

layout(location = 0) out vec4 outColor;

/// Painted wood, red as no grass is.
const vec3 paint = vec3(0.52, 0.075, 0.035);

void main()
{
    const vec3 n = normalize(inNormal);
    const vec3 toEye = normalize(FRAME.view.eye - inPosition);
    const float facing = max(dot(n, FRAME.sunDirection), 0.0);
    const float sunlit = facing > 0.0 ? facing * sunSeen(FRAME.shadow, inPosition, n) : 0.0;
    vec3 color = paint * (hemisphere(n) + FRAME.sunColor * sunlit);

    // Varnish: the sky as in a mirror, by Schlick's edge, and the sun's soft spot.
    const float edge = 0.04 + 0.96 * pow(1.0 - max(dot(n, toEye), 0.0), 5.0);
    const vec3 mirrored = reflect(-toEye, n);
    const float above = smoothstep(-0.1, 0.2, dot(mirrored, FRAME.skyUp));
    color += edge * mix(0.3 * FRAME.groundColor, skyRadiance(mirrored), above);
    const float spot = pow(max(dot(n, normalize(FRAME.sunDirection + toEye)), 0.0), 220.0);
    color += FRAME.sunColor * (0.5 * spot * sunlit);

    if (FRAME.debugMode != 0u)
        color = showsBands() ? vec3(0.0) : vec3(0.5) * (0.5 + 0.5 * facing);
    else
        color = throughAir(color, inPosition);
    outColor = vec4(develop(color), 1.0);
}
