#version 460
#extension GL_GOOGLE_include_directive : require
// The finest level of the depth pyramid, from a picture with four samples per pixel.
#include "shaders/shared/passes.h"

layout(set = 0, binding = 0) uniform sampler2DMS depths;

float farthestAt(ivec2 pixel)
{
    float farthest = 1.0;
    for (int i = 0; i < 4; ++i)
        farthest = min(farthest, texelFetch(depths, pixel, i).x);
    return farthest;
}

#include "shaders/culling/first_level.glsl"
