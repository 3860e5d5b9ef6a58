#version 460
#extension GL_GOOGLE_include_directive : require
// Lists the clusters of the ground that may be seen, in any order: depths and numbers decide what is
// seen, not who comes first.
#include "shaders/shared/culling.h"
#include "shaders/shared/solid.h"

layout(local_size_x = groundThreads) in;
layout(push_constant, scalar) uniform Block { SolidPush push; };
#define JUDGED push.frame.at[0]

#include "shaders/ground/cluster_seen.glsl"

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= push.clusterCount || !clusterSeen(push.clusters.at[index]))
        return;
    SolidWorkArray work = push.work;
    UintArray seen = push.seen;
    const uint place = atomicAdd(work.at[0].clusters.count, 1u);
    seen.at[place] = index;
    atomicMax(work.at[0].clusters.groups[0], min(place + 1u, mostGroups));
}
