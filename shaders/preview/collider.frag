#version 460
#extension GL_GOOGLE_include_directive : require
// The light of a ball or capsule.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/preview/collider_light.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;

layout(location = 0) out vec4 outColor;

void main()
{
    outColor = colliderPicture(inPosition, inNormal);
}
