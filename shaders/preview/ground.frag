#version 460
#extension GL_GOOGLE_include_directive : require
// The light of the ground.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };

#include "shaders/preview/ground_light.glsl"
#include "shaders/preview/image_probes.glsl"

layout(set = 0, binding = 0) uniform sampler2D baseColor;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec4 inColor;

layout(location = 0) out vec4 outColor;

void main()
{
    const GroundMaterial material = push.materials.at[push.material];
    GroundPoint point;
    point.position = inPosition;
    point.normal = inNormal;
    const ImageProbes probes = imageProbes(inUv, dFdx(inUv), dFdy(inUv), vec2(textureSize(baseColor, 0)));
    vec3 texel = vec3(0.0);
    for (uint i = 0u; i < probes.count; ++i)
        texel += textureLod(baseColor, probes.first + float(i) * probes.step, probes.lod).rgb;
    point.albedo = material.baseColor.rgb * (texel / float(probes.count)) * inColor.rgb;
    point.isDoubleSided = (material.flags & groundDoubleSided) != 0u;
    outColor = groundPicture(point);
}
