// The light of the ground where a sample shows it.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/raster/visibility.glsl"
#define AFTER_BLADES
#include "shaders/preview/ground_light.glsl"
#include "shaders/preview/image_probes.glsl"
#include "web/shaders/webgpu/seen_samples.glsl"

struct Material {
    vec3 color;
    uint isDoubleSided;
};

layout(set = 1, binding = 0) uniform MaterialBlock { Material material; };
layout(set = 1, binding = 1) uniform sampler2D baseColor;

layout(location = 0) in vec3 outPosition;
layout(location = 1) in vec3 outNormal;
layout(location = 2) in vec2 outUv;
layout(location = 3) in vec4 outVertexColor;

layout(location = 0) out vec4 outColor;

void main()
{
    const vec2 right = dFdx(outUv);
    const vec2 down = dFdy(outUv);
    const uint first = sampleIndex(uvec2(gl_FragCoord.xy), 0u);
    bool isSeen = false;
    for (uint s = 0u; s < samplesPerPixel; ++s)
        isSeen = isSeen || seenSamples[first + s].x < push.firstBlade;
    outColor = vec4(0.0);
    if (!isSeen)
        return;
    const ImageProbes probes = imageProbes(outUv, right, down, vec2(textureSize(baseColor, 0)));
    vec3 texel = vec3(0.0);
    for (uint i = 0u; i < probes.count; ++i)
        texel += textureLod(baseColor, probes.first + float(i) * probes.step, probes.lod).rgb;
    GroundPoint point;
    point.position = outPosition;
    point.normal = outNormal;
    point.albedo = material.color * (texel / float(probes.count)) * outVertexColor.rgb;
    point.isDoubleSided = material.isDoubleSided != 0u;
    outColor = groundPicture(point);
}
