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
#include "shaders/raster/resolve.glsl"

vec4 shadeAt(uvec2 pixel)
{
    const Lens lens = lensOf();
    const uint64_t seen = Visibility(uvec2(push.visibility)).at[sampleIndex(pixel, 0u)];
    const float depth = uintBitsToFloat(uint(seen >> 32u));
    if (uint(seen) != 0u)
        return shade(lens, uint(seen) - 1u, vec2(pixel), 1u, 0u, depth);
    return depth > 0.0 ? texelFetch(pictures[0], ivec2(pixel), 0) : skyAt(lens, pixel);
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size)))
        return;
    imageStore(picture, ivec2(pixel), stored(shadeAt(pixel).rgb));
}
