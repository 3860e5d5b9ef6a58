#version 460
#extension GL_GOOGLE_include_directive : require
// One point of a blade that the rasteriser has found.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/grass/blade_light.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inTangent;
layout(location = 2) in vec3 inAxis;
layout(location = 3) in vec2 inPlace;
layout(location = 4) in vec4 inRootColor;
layout(location = 5) in vec4 inTipColor;
layout(location = 6) in vec4 inMaterial;
layout(location = 7) in vec3 inUp;

layout(location = 0) out vec4 outColor;

void main()
{
    BladePoint point;
    point.position = inPosition;
    point.tangent = inTangent;
    point.axis = inAxis;
    point.up = inUp;
    point.place = inPlace;
    point.rootColor = inRootColor;
    point.tipColor = inTipColor;
    point.material = inMaterial;
    outColor = vec4(bladePicture(point), 1.0);
}
