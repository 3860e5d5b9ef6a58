#version 460
#extension GL_GOOGLE_include_directive : require
// Begins a visibility with a depth picture of as many samples as it has itself.
layout(set = 0, binding = 0) uniform sampler2DMS depths;

#include "shaders/raster/seed_visibility.glsl"

float depthOfHost(ivec2 pixel, uint s)
{
    return texelFetch(depths, pixel, int(s)).x;
}
