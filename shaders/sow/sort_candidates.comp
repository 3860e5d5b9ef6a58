#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Sorts the candidates of a batch by octree cell, in any order within one.
#include "shaders/sow/batch.glsl"

layout(local_size_x = sowSortThreads) in;

void main()
{
    SowBatch batch = push.batch.at[0];
    const uint i = gl_GlobalInvocationID.x;
    if (i >= min(batch.counts.at[0].records, batch.maxRecords))
        return;
    const SowRecord record = batch.records.at[i];
    batch.sorted.at[atomicAdd(batch.ends.at[record.cell], 1u)] = record;
}
