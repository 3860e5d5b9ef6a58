// Draws the samples of an opaque triangle into the visibility, one after another.
#ifndef SWARD_PREVIEW_DRAW_OPAQUE_GLSL
#define SWARD_PREVIEW_DRAW_OPAQUE_GLSL

#include "shaders/preview/opaque_triangle.glsl"

void drawSample(OpaqueTriangle triangle, uint number, uvec2 pixel, uint s)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    const float depth = depthThrough(triangle, areasAt(triangle, vec2(pixel) + samplePlace(s)));
    if (depth >= 0.0)
        atomicMax(visibility.at[sampleIndex(pixel, s)],
                  (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(number + 1u));
}

void drawPixel(OpaqueTriangle triangle, uint number, uvec2 pixel)
{
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        drawSample(triangle, number, pixel, s);
}

#endif
