#version 460
#extension GL_GOOGLE_include_directive : require
// Initialises a visibility with a depth picture of the same number of samples.
layout(set = 0, binding = 0) uniform sampler2DMS depths;

#include "shaders/raster/seed_visibility.glsl"

float depthOfHost(ivec2 pixel, uint s)
{
    return texelFetch(depths, pixel, int(s)).x;
}
