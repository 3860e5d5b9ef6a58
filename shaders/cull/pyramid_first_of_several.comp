#version 460
#extension GL_GOOGLE_include_directive : require
// The finest level of the depth pyramid, from a picture with several samples per pixel.
#include "shaders/shared/passes.h"

layout(set = 0, binding = 0) uniform sampler2DMS depths;
layout(constant_id = 1) const int sampleCount = 4;

#include "shaders/cull/first_level.glsl"

float farthestAt(ivec2 pixel)
{
    float farthest = 1.0;
    for (int i = 0; i < sampleCount; ++i)
        farthest = min(farthest, reversed(texelFetch(depths, pixel, i).x));
    return farthest;
}
