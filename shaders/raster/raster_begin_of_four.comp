#version 460
#extension GL_GOOGLE_include_directive : require
// Begins a visibility of four samples per pixel.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2DMS pictures[2]; // colour, depth

#include "shaders/raster/visibility.glsl"

float depthAt(ivec2 pixel, int s)
{
    return texelFetch(pictures[1], pixel, s).x;
}

#include "shaders/raster/begin.glsl"
