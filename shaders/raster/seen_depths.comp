#version 460
#extension GL_GOOGLE_include_directive : require
// The finest levels of the depth pyramid, from what the visibility holds: the ground, and the blades
// that have been drawn so far. With that the late pass of large blades begins.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/culling/finest_levels.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/put_sample.glsl"

/// Whether the coarse levels are filled, too, by the work-group that is done last; known when the pipeline
/// is made.
layout(constant_id = 2) const bool fillsAll = false;

// Of several samples: pairs of them in a column of the group's pixels, in what of it a cell has, columns
// that its threads read at a time, and cells of each of which one has pairs that it waits for together.
const uint groupReach = pyramidThreads << pyramidFactorBits;
const uint pairsOfColumn = groupReach * samplesPerPixel / 2u;
const uint pairsOfCell = pairsOfColumn / pyramidThreads;
const uint columnsTogether = pyramidThreads * pyramidThreads / pairsOfColumn;
const uint cellsTogether = 2u;

shared uint farthestOfCells[pyramidThreads * pyramidThreads]; // as bits
shared bool isLastGroup;

/// The farthest depth of a cell, read by its own thread.
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

/// The same where a pixel has several samples: a cell's lie so far apart that threads beside one another
/// read pairs beside one another instead, whosever they are. All threads come here together.
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

/// What is listed of large blades from now on has its late pass, and what is has had its first one; but
/// those that the near plane cuts have been drawn for good.
void beginLatePass()
{
    WalkLevelArray asked = push.largeCount;
    const uint listed = listedLarge();
    asked.at[largeEarly].count = listed;
    asked.at[largeCut].count = 0u;
    asked.at[largeCut].groups[0] = 0u;
    asked.at[largeLate].groups[0] = groupsForLate(listed);
}

/// Whether all other work-groups have filled their cells. The first thread comes here behind the last one
/// that it has put, of which alone coarser levels are made.
bool areOthersDone()
{
    memoryBarrierBuffer();
    WalkLevelArray asked = push.largeCount;
    return atomicAdd(asked.at[largeLate].count, 1u) + 1u == gl_NumWorkGroups.x * gl_NumWorkGroups.y;
}

void main()
{
    if (gl_WorkGroupID.xy == uvec2(0u) && gl_LocalInvocationIndex == 0u)
        beginLatePass();
    // Threads beside one another read what lies below one another, which is together in memory.
    const uvec2 own = gl_LocalInvocationID.yx;
    putFinestLevels(FRAME.pyramid, own, samplesPerPixel == 1u ? farthestOf(own) : farthestTogether(own));
    if (!fillsAll)
        return;
    if (gl_LocalInvocationIndex == 0u)
        isLastGroup = areOthersDone();
    barrier();
    if (!isLastGroup)
        return;
    memoryBarrierBuffer();
    putCoarseLevels(FRAME.pyramid, gl_LocalInvocationIndex, pyramidThreads * pyramidThreads);
}
