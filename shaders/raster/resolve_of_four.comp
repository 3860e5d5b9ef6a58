#version 460
#extension GL_GOOGLE_include_directive : require
// Shades a visibility of four samples per pixel; soften.comp makes the picture.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2DMS pictures[2]; // colour, depth
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D shaded;

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"

vec4 groundAt(ivec2 pixel, int s)
{
    return texelFetch(pictures[0], pixel, s);
}

#include "shaders/raster/stored.glsl"

void put(ivec2 pixel, vec4 color)
{
    imageStore(shaded, pixel, halfRounded(color));
}

#include "shaders/raster/resolve.glsl"
