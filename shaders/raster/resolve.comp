#version 460
#extension GL_GOOGLE_include_directive : require
// Makes the picture of a visibility of one sample per pixel.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2D pictures[2]; // colour, depth
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D picture;

#include "shaders/raster/stored.glsl"
#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"

vec4 groundAt(ivec2 pixel, int s)
{
    return texelFetch(pictures[0], pixel, 0);
}

void put(ivec2 pixel, vec4 color)
{
    imageStore(picture, pixel, stored(color.rgb));
}

#include "shaders/raster/resolve.glsl"
