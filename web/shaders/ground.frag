// The light of the ground.
#include "web/shaders/frame.glsl"
#define AFTER_BLADES
#include "shaders/preview/ground_light.glsl"
#include "shaders/preview/image_probes.glsl"
#include "web/shaders/middle.glsl"

uniform sampler2D baseColor;
uniform vec3 materialColor;
uniform bool isDoubleSided;

in vec3 outPosition;
in vec3 outNormal;
in vec2 outUv;
in vec4 outVertexColor;

layout(location = 0) out vec4 outColor;

void main()
{
    const ImageProbes probes = imageProbes(inMiddle(outUv), dFdx(outUv), dFdy(outUv), vec2(textureSize(baseColor, 0)));
    vec3 texel = vec3(0.0);
    for (uint i = 0u; i < probes.count; ++i)
        texel += textureLod(baseColor, probes.first + float(i) * probes.step, probes.lod).rgb;
    GroundPoint point;
    point.position = inMiddle(outPosition);
    point.normal = inMiddle(outNormal);
    point.albedo = materialColor * (texel / float(probes.count)) * outVertexColor.rgb;
    point.isDoubleSided = isDoubleSided;
#ifdef IN_HOST
    outColor = vec4(forHost(groundPicture(point).rgb), 1.0);
#else
    outColor = groundPicture(point);
#endif
}
