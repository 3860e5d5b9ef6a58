#version 460
#extension GL_GOOGLE_include_directive : require
// One level of the depth pyramid from the one below.
#include "shaders/shared/passes.h"

layout(local_size_x = pyramidThreads, local_size_y = pyramidThreads) in;
layout(push_constant, scalar) uniform Block { PyramidPush push; };

void main()
{
    DepthPyramid pyramid = push.frame.at[0].pyramid;
    const uint level = push.level;
    const uvec2 cell = gl_GlobalInvocationID.xy;
    const uvec2 cells =
        uvec2(pyramidCells(pyramid.size.x, level), pyramidCells(pyramid.size.y, level));
    if (any(greaterThanEqual(cell, cells)))
        return;
    const uvec2 below =
        uvec2(pyramidCells(pyramid.size.x, level - 1u), pyramidCells(pyramid.size.y, level - 1u));
    const uvec2 low = cell << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), below);
    DepthArray depths = pyramid.depths;
    float farthest = 1.0;
    for (uint y = low.y; y < high.y; ++y)
        for (uint x = low.x; x < high.x; ++x)
            farthest = min(farthest, depths.at[pyramid.first[level - 1u] + y * below.x + x]);
    depths.at[pyramid.first[level] + cell.y * cells.x + cell.x] = farthest;
}
