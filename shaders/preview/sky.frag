#version 460
#extension GL_GOOGLE_include_directive : require
// The sky with its sun.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/common/sky_light.glsl"

layout(location = 0) in vec3 inRay;

layout(location = 0) out vec4 outColor;

void main()
{
    outColor = vec4(skyPicture(normalize(inRay), gl_FragCoord.xy), 1.0);
}
