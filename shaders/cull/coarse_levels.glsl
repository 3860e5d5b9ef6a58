// The coarse levels of a depth pyramid, each from the one below, by a single work-group. One dispatch per level would
// spend more time waiting than working.
#ifndef SWARD_CULL_COARSE_LEVELS_GLSL
#define SWARD_CULL_COARSE_LEVELS_GLSL

#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/shared/passes.h"

/// A pyramid's depths; coherent, because threads read each other's values.
layout(buffer_reference, scalar, buffer_reference_align = 4) coherent buffer SharedDepths
{
    float at[];
};

/// The level below, if a group has a thread for each of its cells. Reading it from memory would take longer than all
/// other work.
shared float cellsBelow[pyramidThreads * pyramidThreads];

/// The farthest depth of the level below inside cell `cell` of a level.
float farthestBelow(SharedDepths depths, uint first, uvec2 below, uvec2 cell, bool isShared)
{
    const uvec2 low = cell << pyramidFactorBits;
    float farthest = 1.0;
    // Reads all cells at once: reading one by one takes ten times as long.
    SHARED_UNROLL for (uint y = 0u; y < 1u << pyramidFactorBits; ++y)
        SHARED_UNROLL for (uint x = 0u; x < 1u << pyramidFactorBits; ++x) {
            const uvec2 part = min(low + uvec2(x, y), below - 1u);
            const uint i = part.y * below.x + part.x;
            farthest = min(farthest, isShared ? cellsBelow[i] : depths.at[first + i]);
        }
    return farthest;
}

/// All `threads` of a group call this together, at most one per entry of cellsBelow. The three finest levels exist.
void putCoarseLevels(DepthPyramid pyramid, uint thread, uint threads)
{
    SharedDepths depths = SharedDepths(uvec2(pyramid.depths));
    bool isShared = false;
    for (uint level = pyramidFirstOfRest; level < pyramid.levels; ++level) {
        const uvec2 cells =
            uvec2(pyramidCells(pyramid.size.x, level), pyramidCells(pyramid.size.y, level));
        const uvec2 below = uvec2(pyramidCells(pyramid.size.x, level - 1u),
                                  pyramidCells(pyramid.size.y, level - 1u));
        float farthest = 1.0;
        for (uint i = thread; i < cells.x * cells.y; i += threads) {
            farthest = farthestBelow(depths, pyramid.first[level - 1u], below,
                                     uvec2(i % cells.x, i / cells.x), isShared);
            depths.at[pyramid.first[level] + i] = farthest;
        }
        memoryBarrierBuffer();
        barrier();
        isShared = cells.x * cells.y <= threads;
        if (isShared)
            cellsBelow[thread] = farthest;
        barrier();
    }
}

#endif
