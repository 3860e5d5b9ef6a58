#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Culls the clusters of a part of the ground. A first dispatch finds those that may be visible, one bit for each; a
// second writes their draws, in cluster order. So the same one of several equally deep triangles is always drawn first.
#include "shaders/shared/constants.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/passes.h"

layout(local_size_x = groundThreads) in;
layout(push_constant, scalar) uniform Block { GroundCullPush push; };
#define CULL_VIEW push.frame.at[0]

#include "shaders/preview/cluster_seen.glsl"

// Which of both dispatches this is; known at pipeline creation.
layout(constant_id = idWritesDraws) const bool writesDraws = false;

shared uint words[groundWords];
shared uint before; // draws of the work-groups before this one

void findSeen(uint thread)
{
    const uint index = gl_GlobalInvocationID.x;
    if (thread < groundWords)
        words[thread] = 0u;
    barrier();
    if (index < push.clusterCount && clusterSeen(push.clusters.at[index]))
        atomicOr(words[thread / 32u], 1u << (thread % 32u));
    barrier();
    if (thread < groundWords)
        push.seen.at[gl_WorkGroupID.x * groundWords + thread] = words[thread];
}

void writeDraws(uint thread)
{
    const uint firstWord = gl_WorkGroupID.x * groundWords;
    if (thread == 0u)
        before = 0u;
    barrier();
    uint sum = 0u;
    for (uint word = thread; word < firstWord; word += groundThreads)
        sum += uint(bitCount(push.seen.at[word]));
    if (sum > 0u)
        atomicAdd(before, sum);
    barrier();

    const uint ownWord = firstWord + thread / 32u;
    const uint own = push.seen.at[ownWord];
    const uint bit = 1u << (thread % 32u);
    uint place = before + uint(bitCount(own & (bit - 1u)));
    for (uint word = firstWord; word < ownWord; ++word)
        place += uint(bitCount(push.seen.at[word]));
    if ((own & bit) != 0u) {
        const GroundCluster cluster = push.clusters.at[gl_GlobalInvocationID.x];
        const uint firstIndex = 3u * clusterTriangles * (push.firstCluster + gl_GlobalInvocationID.x);
        push.draws.at[push.firstCluster + place] = IndexedDraw(cluster.indexCount, 1u, firstIndex, 0u, 0u);
    }
    if (gl_WorkGroupID.x + 1u == gl_NumWorkGroups.x && thread + 1u == groundThreads)
        push.drawCount.at[0] = place + ((own & bit) != 0u ? 1u : 0u);
}

void main()
{
    if (writesDraws)
        writeDraws(gl_LocalInvocationIndex);
    else
        findSeen(gl_LocalInvocationIndex);
}
