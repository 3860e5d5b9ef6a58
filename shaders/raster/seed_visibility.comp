#version 460
#extension GL_GOOGLE_include_directive : require
// Initialises a visibility with a depth picture of one sample per pixel.
layout(set = 0, binding = 0) uniform sampler2D depths;

#include "shaders/raster/seed_visibility.glsl"

float depthOfHost(ivec2 pixel, uint s)
{
    return texelFetch(depths, pixel, 0).x;
}
