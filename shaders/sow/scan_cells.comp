#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Gives the candidates of each octree cell of a batch their part of the sorted list, and lists the cells that have any.
// A work-group for each unit.
#include "shaders/sow/batch.glsl"

layout(local_size_x = sowScanThreads) in;

const int cellsOfThread = int(sowCells / sowScanThreads); // two

shared uint sums[sowScanThreads];
shared uint growing;
shared uint firstRecord;
shared uint firstGrowing;

void main()
{
    SowBatch batch = push.batch.at[0];
    const uint thread = gl_LocalInvocationID.x;
    const uint first = sowCells * gl_WorkGroupID.x + uint(cellsOfThread) * thread;
    uint own = 0u;
    for (int i = 0; i < cellsOfThread; ++i)
        own += batch.cells.at[first + uint(i)];
    sums[thread] = own;
    if (thread == 0u)
        growing = 0u;
    barrier();
    for (uint step = 1u; step < sowScanThreads; step *= 2u) {
        const uint before = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    uvec2 place = uvec2(0u);
    for (int i = 0; i < cellsOfThread; ++i)
        if (batch.cells.at[first + uint(i)] > 0u)
            place[i] = atomicAdd(growing, 1u);
    barrier();
    // Units come in any order.
    if (thread == 0u) {
        firstRecord = atomicAdd(batch.counts.at[0].sorted, sums[sowScanThreads - 1u]);
        firstGrowing = atomicAdd(batch.counts.at[0].layGroups[0], growing);
    }
    barrier();
    uint next = firstRecord + sums[thread] - own;
    for (int i = 0; i < cellsOfThread; ++i) {
        const uint here = batch.cells.at[first + uint(i)];
        batch.ends.at[first + uint(i)] = next;
        next += here;
        if (here > 0u)
            batch.growing.at[firstGrowing + place[i]] = first + uint(i);
    }
    if (gl_WorkGroupID.x == 0u && thread == 0u) {
        const uint records = min(batch.counts.at[0].records, batch.maxRecords);
        batch.counts.at[0].sortGroups[0] = (records + sowSortThreads - 1u) / sowSortThreads;
        batch.counts.at[0].growGroups[0] = (records + sowGrowThreads - 1u) / sowGrowThreads;
        for (uint axis = 1u; axis < 3u; ++axis) {
            batch.counts.at[0].sortGroups[axis] = 1u;
            batch.counts.at[0].growGroups[axis] = 1u;
            batch.counts.at[0].layGroups[axis] = 1u;
        }
    }
}
