#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// The light of the ground.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };

#include "shaders/lighting.glsl"
#include "shaders/shared/noise.h"

layout(set = 0, binding = 0) uniform sampler2D baseColor;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec4 inColor;

layout(location = 0) out vec4 outColor;

/// Grains and crumbs of the ground: how much brighter it is here than its colour, 1 on average, for
/// as many sizes as a pixel of the picture can show.
float grain(float pixel)
{
    float sum = 0.0;
    float size = 0.32; // [m]
    for (uint octave = 0u; octave < 4u; ++octave) {
        const float shown = clamp(0.35 * size / pixel - 1.0, 0.0, 1.0);
        if (shown <= 0.0)
            break;
        sum += shown * (valueNoise(inPosition / size + 17.0 * float(octave)) - 0.5);
        size *= 0.37;
    }
    return 1.0 + 0.4 * sum;
}

/// Whether blades hide all samples of the pixel.
bool isOvergrown()
{
    if (uvec2(push.visibility) == uvec2(0u))
        return false;
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint first = (pixel.y * push.width + pixel.x) * FRAME.view.samples;
    for (uint s = 0u; s < FRAME.view.samples; ++s)
        if (push.visibility.at[first + s].x == 0u)
            return false;
    return true;
}

/// Colour of what has fallen among the grass: last year's leaves, and this year's stems.
const vec3 litterColor = vec3(0.135, 0.120, 0.048);

void main()
{
    // Before neighbours may be gone.
    const vec2 uvRight = dFdx(inUv);
    const vec2 uvDown = dFdy(inUv);
    outColor = vec4(0.0);
    if (isOvergrown())
        return;
    const GroundMaterial material = push.materials.at[push.material];
    vec3 albedo = material.baseColor.rgb * textureGrad(baseColor, inUv, uvRight, uvDown).rgb * inColor.rgb;
    const vec3 toEye = normalize(FRAME.view.eye - inPosition);
    vec3 n = normalize(inNormal);
    if ((material.flags & groundDoubleSided) != 0u && dot(n, toEye) < 0.0)
        n = -n;

    const float facing = max(dot(n, FRAME.sunDirection), 0.0);
    // The grass around takes its share of the light, as far as it is drawn.
    const float distance = length(FRAME.view.eye - inPosition);
    const float farthest = FRAME.cover.farthest;
    const float grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance);
    const float leafArea = leafAreaAt(FRAME.cover, inPosition) * grown;
    albedo = mix(albedo, litterColor, 0.8 * (1.0 - exp(-0.7 * leafArea))) * grain(distance / FRAME.view.pixelsPerUnit);
    const float seen = facing > 0.0 ? sunSeen(FRAME.shadow, inPosition, n) : 0.0;
    const vec3 light = hemisphere(n) * skyBelow(leafArea) + lightAmongLeaves(leafArea, facing, seen) +
                       FRAME.sunColor * (facing * seen * sunBelow(leafArea, facing));
    vec3 color = albedo * light;
    if (FRAME.debugMode != 0u)
        color = showsBands() ? vec3(0.0) : vec3(0.35) * (0.5 + 0.5 * facing);
    else
        color = throughAir(color, inPosition);
    if (paintsWind)
        color = colorOfWind(inPosition, n);
    // Among grass the ground is as soft as what stands on it.
    outColor = vec4(develop(color), 1.0 - softness(distance, min(leafArea, 1.0)));
}
