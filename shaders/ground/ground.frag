#version 460
#extension GL_GOOGLE_include_directive : require
// The light of the ground.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };

#include "shaders/lighting.glsl"

layout(set = 0, binding = 0) uniform sampler2D baseColor;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec4 inColor;

layout(location = 0) out vec4 outColor;

void main()
{
    const GroundMaterial material = push.materials.at[push.material];
    const vec3 albedo = material.baseColor.rgb * texture(baseColor, inUv).rgb * inColor.rgb;
    const vec3 toEye = normalize(FRAME.eye - inPosition);
    vec3 n = normalize(inNormal);
    if ((material.flags & groundDoubleSided) != 0u && dot(n, toEye) < 0.0)
        n = -n;

    const float facing = max(dot(n, FRAME.sunDirection), 0.0);
    // The grass around takes its share of the light, as far as it is drawn.
    const float distance = length(FRAME.eye - inPosition);
    const float farthest = FRAME.cover.farthest;
    const float grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance);
    const float leafArea = leafAreaAt(FRAME.cover, inPosition) * grown;
    float sunlit = facing * sunBelow(leafArea, facing);
    if (facing > 0.0)
        sunlit *= sunSeen(FRAME.shadow, inPosition, n);
    vec3 color = albedo * (hemisphere(n) * skyBelow(leafArea) + FRAME.sunColor * sunlit);
    if (FRAME.debugMode != 0u)
        color = vec3(0.35) * (0.5 + 0.5 * facing);
    else
        color = throughAir(color, inPosition);
    if (paintsWind)
        color = colorOfWind(inPosition, n);
    outColor = vec4(develop(color), 1.0);
}
