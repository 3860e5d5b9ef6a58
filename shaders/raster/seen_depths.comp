#version 460
#extension GL_GOOGLE_include_directive : require
// The finest levels of the depth pyramid, from the visibility: the ground, and the blades drawn so far. This starts the
// late pass of large blades.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/cull/finest_levels.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/last_group.glsl"
#include "shaders/raster/put_sample.glsl"

/// Whether the last work-group to finish also fills the coarse levels; known at pipeline creation.
layout(constant_id = idFillsAll) const bool fillsAll = false;

// For several samples: number of sample pairs in a column of the group's pixels, and in a cell's part of it; number of
// columns that the threads read at a time; number of cells whose pairs a thread reads with one wait.
const uint groupReach = pyramidThreads << pyramidFactorBits;
const uint pairsOfColumn = groupReach * samplesPerPixel / 2u;
const uint pairsOfCell = pairsOfColumn / pyramidThreads;
const uint columnsTogether = pyramidThreads * pyramidThreads / pairsOfColumn;
const uint cellsTogether = 2u;

shared uint farthestOfCells[pyramidThreads * pyramidThreads]; // as bits

/// The farthest depth of a cell, read by the cell's own thread.
float farthestOf(uvec2 own)
{
    const uvec2 low = (gl_WorkGroupID.xy * pyramidThreads + own) << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), push.size);
    uint farthest = floatBitsToUint(1.0);
    for (uint x = low.x; x < high.x && low.y < high.y; ++x) {
        const uint first = sampleIndex(uvec2(x, low.y), 0u);
        SHARED_UNROLL for (uint i = 0u; i < 1u << pyramidFactorBits; i += 2u) {
            const uvec2 two = depthsAt(first + i);
            if (low.y + i < high.y)
                farthest = min(farthest, two.x);
            if (low.y + i + 1u < high.y)
                farthest = min(farthest, two.y);
        }
    }
    return uintBitsToFloat(farthest);
}

/// The same for several samples per pixel. The pairs of a cell lie far apart, so neighbouring threads read neighbouring
/// pairs of any cell. All threads call this together.
float farthestTogether(uvec2 own)
{
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 corner = gl_WorkGroupID.xy * groupReach;
    const uint pair = thread % pairsOfColumn;
    const uint row = corner.y + 2u * pair / samplesPerPixel;
    farthestOfCells[thread] = floatBitsToUint(1.0);
    barrier();
    for (uint first = thread / pairsOfColumn; first < pyramidThreads; first += columnsTogether * cellsTogether) {
        uint farthest[cellsTogether];
        SHARED_UNROLL for (uint i = 0u; i < cellsTogether; ++i) {
            farthest[i] = floatBitsToUint(1.0);
            SHARED_UNROLL for (uint x = 0u; x < 1u << pyramidFactorBits; ++x) {
                const uint column =
                    corner.x + ((first + i * columnsTogether) << pyramidFactorBits) + x;
                if (column < push.size.x && row < push.size.y) {
                    const uvec2 two = depthsAt(sampleIndex(uvec2(column, corner.y), 0u) + 2u * pair);
                    farthest[i] = min(farthest[i], min(two.x, two.y));
                }
            }
        }
        SHARED_UNROLL for (uint i = 0u; i < cellsTogether; ++i)
            atomicMin(farthestOfCells[pair / pairsOfCell * pyramidThreads + first + i * columnsTogether],
                      farthest[i]);
    }
    barrier();
    return uintBitsToFloat(farthestOfCells[own.y * pyramidThreads + own.x]);
}

/// Starts the late pass: blades listed so far are early, blades listed later are late. Empties the list of cut blades,
/// which are drawn completely.
void beginLatePass()
{
    WalkLevelArray lists = push.largeCount;
    const uint listed = listedLarge();
    lists.at[largeEarly].count = listed;
    lists.at[largeCut].count = 0u;
    lists.at[largeCut].groups[0] = 0u;
    lists.at[largeLate].groups[0] = groupsForLate(listed);
}

void main()
{
    if (gl_WorkGroupID.xy == uvec2(0u) && gl_LocalInvocationIndex == 0u)
        beginLatePass();
    // Neighbouring threads read vertically adjacent pixels, which are adjacent in memory.
    const uvec2 own = gl_LocalInvocationID.yx;
    putFinestLevels(FRAME.pyramid, own, samplesPerPixel == 1u ? farthestOf(own) : farthestTogether(own));
    if (fillsAll && isLastGroup())
        putCoarseLevels(FRAME.pyramid, gl_LocalInvocationIndex, pyramidThreads * pyramidThreads);
}
