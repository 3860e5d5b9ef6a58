#version 460
#extension GL_GOOGLE_include_directive : require
// The finest levels of the depth pyramid, from a depth picture.
#include "shaders/cull/finest_levels.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { PyramidPush push; };
#ifdef SEVERAL_SAMPLES
layout(set = 0, binding = 0) uniform sampler2DMS depths;
#else
layout(set = 0, binding = 0) uniform sampler2D depths;
#endif

// Known at pipeline creation: samples per pixel, and whether depths are 0 near and 1 far.
layout(constant_id = idSamplesPerPixel) const uint samplesPerPixel = 1u;
layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;

/// The depth with 1 near and 0 far.
float reversed(float depth)
{
    return hasForwardZ ? 1.0 - depth : depth;
}

/// The reversed depth of the farthest of a pixel's samples. A picture of one sample has a level in its place.
float farthestAt(ivec2 pixel)
{
    float farthest = 1.0;
    for (uint s = 0u; s < samplesPerPixel; ++s)
        farthest = min(farthest, reversed(texelFetch(depths, pixel, int(s)).x));
    return farthest;
}

void main()
{
    DepthPyramid pyramid = push.frame.at[0].pyramid;
    const uvec2 low = gl_GlobalInvocationID.xy << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), pyramid.size);
    float farthest = 1.0;
    for (uint y = low.y; y < high.y; ++y)
        for (uint x = low.x; x < high.x; ++x)
            farthest = min(farthest, farthestAt(ivec2(x, y)));
    if (all(lessThan(low, high)))
        farthest -= push.slack;
    putFinestLevels(pyramid, gl_LocalInvocationID.xy, farthest);
}
