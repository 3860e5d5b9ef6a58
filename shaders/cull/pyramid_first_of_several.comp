#version 460
#extension GL_GOOGLE_include_directive : require
// The finest level of the depth pyramid, from a picture with several samples per pixel.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(set = 0, binding = 0) uniform sampler2DMS depths;
layout(constant_id = idSamplesPerPixel) const uint samplesPerPixel = 1u;

#include "shaders/cull/first_level.glsl"

float farthestAt(ivec2 pixel)
{
    float farthest = 1.0;
    for (uint s = 0u; s < samplesPerPixel; ++s)
        farthest = min(farthest, reversed(texelFetch(depths, pixel, int(s)).x));
    return farthest;
}
