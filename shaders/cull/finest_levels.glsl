// The three finest levels of a depth pyramid at once: a work-group has the cells of the finest level that form one cell
// of the third.
#ifndef SWARD_CULL_FINEST_LEVELS_GLSL
#define SWARD_CULL_FINEST_LEVELS_GLSL

#include "shaders/cull/coarse_levels.glsl"

layout(local_size_x = pyramidThreads, local_size_y = pyramidThreads) in;

const uint factor = 1u << pyramidFactorBits;
const uint cellsOfSecond = pyramidThreads / factor; // along each axis

shared float depthsOfFirst[pyramidThreads * pyramidThreads];
shared float depthsOfSecond[cellsOfSecond * cellsOfSecond];

void putCell(DepthPyramid pyramid, uint level, uvec2 cell, float farthest)
{
    const uvec2 cells =
        uvec2(pyramidCells(pyramid.size.x, level), pyramidCells(pyramid.size.y, level));
    if (level >= pyramid.levels || any(greaterThanEqual(cell, cells)))
        return;
    SharedDepths depths = SharedDepths(uvec2(pyramid.depths));
    depths.at[pyramid.first[level] + cell.y * cells.x + cell.x] = farthest;
}

/// Called by every thread of the group, with one of its cells of the finest level and the farthest depth there, or 1
/// where there is no depth.
void putFinestLevels(DepthPyramid pyramid, uvec2 own, float farthest)
{
    const uint thread = gl_LocalInvocationIndex;
    putCell(pyramid, 0u, gl_WorkGroupID.xy * pyramidThreads + own, farthest);
    depthsOfFirst[own.y * pyramidThreads + own.x] = farthest;
    barrier();
    if (thread < cellsOfSecond * cellsOfSecond) {
        const uvec2 cell = uvec2(thread % cellsOfSecond, thread / cellsOfSecond);
        const uint corner = (cell.y * pyramidThreads + cell.x) * factor;
        float least = 1.0;
        for (uint i = 0u; i < factor * factor; ++i)
            least = min(least, depthsOfFirst[corner + i / factor * pyramidThreads + i % factor]);
        putCell(pyramid, 1u, gl_WorkGroupID.xy * cellsOfSecond + cell, least);
        depthsOfSecond[thread] = least;
    }
    barrier();
    if (thread > 0u)
        return;
    float least = 1.0;
    for (uint i = 0u; i < cellsOfSecond * cellsOfSecond; ++i)
        least = min(least, depthsOfSecond[i]);
    putCell(pyramid, 2u, gl_WorkGroupID.xy, least);
}

#endif
