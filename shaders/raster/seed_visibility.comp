#version 460
#extension GL_GOOGLE_include_directive : require
// Initialises a visibility with a host's depths: value 0 at the depth of the host's geometry. Fills the view's depth
// pyramid from these depths, if it has one. The depth picture has the visibility's number of samples. A work-group has
// one cell of the pyramid's third level, each thread one cell of the finest.
#include "shaders/cull/finest_levels.glsl"
#define HAS_INSTANCES // it reads no frame but for the pyramid
#include "shaders/raster/instances.glsl"
#include "shaders/raster/last_group.glsl"
#include "shaders/raster/put_sample.glsl"
#include "shaders/shared/constants.h"

/// Whether depths are 0 near and 1 far; known at pipeline creation.
layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;

#ifdef SEVERAL_SAMPLES
layout(set = 0, binding = 0) uniform sampler2DMS depths;
#else
layout(set = 0, binding = 0) uniform sampler2D depths;
#endif

/// The reversed depth of a sample, as bits. A picture of one sample has a level in its place.
uint depthOfHost(uvec2 pixel, uint s)
{
    const float depth = texelFetch(depths, ivec2(min(pixel, host.size - 1u)), int(s)).x;
    return floatBitsToUint(max((hasForwardZ ? 1.0 - depth : depth) - host.slack, 0.0));
}

/// Initialises the samples of a cell; returns the farthest depth. Columns have room for whole cells.
float seedCell(uvec2 low)
{
    const uint edge = 1u << pyramidFactorBits;
    VisibilityPairs pairs = VisibilityPairs(uvec2(push.visibility));
    uint farthest = floatBitsToUint(1.0);
    for (uint x = low.x; x < min(low.x + edge, host.size.x) && low.y < host.size.y; ++x) {
        const uint first = sampleIndex(uvec2(x, low.y), 0u) / 2u;
        SHARED_UNROLL for (uint i = 0u; i < edge * samplesPerPixel; i += 2u) {
            const uint row = low.y + i / samplesPerPixel;
            const uint nextRow = low.y + (i + 1u) / samplesPerPixel;
            const uint one = depthOfHost(uvec2(x, row), i % samplesPerPixel);
            const uint other = depthOfHost(uvec2(x, nextRow), (i + 1u) % samplesPerPixel);
            pairs.at[first + i / 2u] = uvec4(0u, one, 0u, other);
            if (row < host.size.y)
                farthest = min(farthest, one);
            if (nextRow < host.size.y)
                farthest = min(farthest, other);
        }
    }
    return uintBitsToFloat(farthest);
}

void main()
{
    push.size = host.size;
    push.visibility = host.visibility;
    // Neighbouring threads have vertically adjacent cells, which are adjacent in memory.
    const uvec2 own = gl_LocalInvocationID.yx;
    const float farthest = seedCell((gl_WorkGroupID.xy * pyramidThreads + own) << pyramidFactorBits);
    if (host.instanceCount == 0u)
        return;
    beginInstances();
    DepthPyramid pyramid = FRAME.pyramid;
    if (uvec2(pyramid.depths) == uvec2(0u))
        return;
    putFinestLevels(pyramid, own, farthest);
    if (isLastGroup())
        putCoarseLevels(pyramid, gl_LocalInvocationIndex, pyramidThreads * pyramidThreads);
}
