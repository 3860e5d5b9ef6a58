#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Gives the candidates of each octree cell of a batch their part of the sorted list, and lists the cells that have any.
// One work-group.
#include "shaders/sow/batch.glsl"

layout(local_size_x = sowScanThreads) in;

shared uint sums[sowScanThreads];
shared uint growing;

void main()
{
    SowBatch batch = push.batch.at[0];
    const uint thread = gl_LocalInvocationID.x;
    const uint count = sowCells * batch.unitCount;
    const uint each = (count + sowScanThreads - 1u) / sowScanThreads;
    const uint first = min(thread * each, count);
    const uint end = min(first + each, count);
    uint own = 0u;
    for (uint i = first; i < end; ++i)
        own += batch.cells.at[i];
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
    uint next = sums[thread] - own;
    for (uint i = first; i < end; ++i) {
        const uint here = batch.cells.at[i];
        batch.ends.at[i] = next;
        next += here;
        if (here > 0u)
            batch.growing.at[atomicAdd(growing, 1u)] = i;
    }
    barrier();
    if (thread == 0u) {
        const uint records = min(batch.counts.at[0].records, batch.maxRecords);
        batch.counts.at[0].sortGroups[0] = (records + sowSortThreads - 1u) / sowSortThreads;
        batch.counts.at[0].growGroups[0] = (records + sowGrowThreads - 1u) / sowGrowThreads;
        batch.counts.at[0].layGroups[0] = growing;
        for (uint axis = 1u; axis < 3u; ++axis) {
            batch.counts.at[0].sortGroups[axis] = 1u;
            batch.counts.at[0].growGroups[axis] = 1u;
            batch.counts.at[0].layGroups[axis] = 1u;
        }
    }
}
