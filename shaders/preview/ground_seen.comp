#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Finds the potentially visible clusters of a part of the ground: one bit for each.
#include "shaders/shared/culling.h"
#include "shaders/shared/passes.h"

layout(local_size_x = groundThreads) in;
layout(push_constant, scalar) uniform Block { GroundCullPush push; };
#define CULL_VIEW push.frame.at[0]

#include "shaders/preview/cluster_seen.glsl"

shared uint words[groundWords];

void main()
{
    const uint thread = gl_LocalInvocationIndex;
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
