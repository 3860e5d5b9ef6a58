#version 460
#extension GL_GOOGLE_include_directive : require
// The nearest of some of a pixel's four depths.
#include "shaders/shared/passes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2DMS depths;
layout(constant_id = 0) const bool hasForwardZ = false;
layout(constant_id = 1) const int firstSample = 0;
layout(constant_id = 2) const int endSample = 4;

layout(push_constant, scalar) uniform Block { FloatArray nearest; };

void main()
{
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = textureSize(depths);
    if (any(greaterThanEqual(pixel, size)))
        return;
    float depth = texelFetch(depths, pixel, firstSample).x;
    for (int s = firstSample + 1; s < endSample; ++s) {
        const float other = texelFetch(depths, pixel, s).x;
        depth = hasForwardZ ? min(depth, other) : max(depth, other);
    }
    nearest.at[pixel.y * size.x + pixel.x] = depth;
}
