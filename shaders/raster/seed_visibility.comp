#version 460
#extension GL_GOOGLE_include_directive : require
// Initialises a visibility with a host's depths: value 0 at the depth of the host's geometry. Fills the view's depth
// pyramid from these depths, if it has one. The depth picture has the visibility's number of samples. A work-group has
// one cell of the pyramid's third level.
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

// Pairs of samples in a column of the group's pixels, and in a cell's part of it; columns that the threads take at a time.
const uint edge = 1u << pyramidFactorBits;
const uint pairsOfColumn = (pyramidThreads << pyramidFactorBits) * samplesPerPixel / 2u;
const uint pairsOfCell = pairsOfColumn / pyramidThreads;
const uint columnsTogether = pyramidThreads * pyramidThreads / pairsOfColumn;

shared uint farthestOfCells[pyramidThreads * pyramidThreads]; // as bits

/// Initialises two samples that lie together in memory; returns the farther depth. The last row of an odd height has
/// room for another.
uint seedPair(uint column, uint row, uint pair)
{
    const uint s = (2u * pair) % samplesPerPixel;
    const uint one = depthOfHost(uvec2(column, row), s);
    const uint other = samplesPerPixel > 1u ? depthOfHost(uvec2(column, row), s + 1u)
                                            : depthOfHost(uvec2(column, row + 1u), 0u);
    VisibilityPairs pairs = VisibilityPairs(uvec2(push.visibility));
    pairs.at[(sampleIndex(uvec2(column, row), s)) / 2u] = uvec4(0u, one, 0u, other);
    return min(one, other);
}

/// Initialises the samples of a group's pixels; returns the farthest depth of the thread's own cell. Neighbouring
/// threads write neighbouring pairs of any cell.
float seedTogether(uvec2 own)
{
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 corner = gl_WorkGroupID.xy * (pyramidThreads << pyramidFactorBits);
    const uint pair = thread % pairsOfColumn;
    const uint row = corner.y + 2u * pair / samplesPerPixel;
    farthestOfCells[thread] = floatBitsToUint(1.0);
    barrier();
    for (uint x = thread / pairsOfColumn; x < pyramidThreads << pyramidFactorBits; x += columnsTogether)
        if (corner.x + x < host.size.x && row < host.size.y)
            atomicMin(farthestOfCells[pair / pairsOfCell * pyramidThreads + x / edge],
                      seedPair(corner.x + x, row, pair));
    barrier();
    return uintBitsToFloat(farthestOfCells[own.y * pyramidThreads + own.x]);
}

void main()
{
    push.size = host.size;
    push.visibility = host.visibility;
    const uvec2 own = gl_LocalInvocationID.xy;
    const float farthest = seedTogether(own);
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
