#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Finds the clusters of a part of the ground that may be seen: a bit for each.
#include "shaders/shared/culling.h"
#include "shaders/shared/passes.h"

layout(local_size_x = groundThreads) in;
layout(push_constant, scalar) uniform Block { GroundCullPush push; };
#define JUDGED push.frame.at[0]

#include "shaders/culling/hidden.glsl"

shared uint words[groundWords];

bool clusterSeen(GroundCluster cluster)
{
    // Planes and places are rounded; a hundred-thousandth of the distance is more than both.
    const vec3 eye = JUDGED.view.eye;
    const vec3 farthest = max(abs(cluster.low - eye), abs(cluster.high - eye));
    const vec3 margin = vec3(1e-5 * length(farthest));
    const vec3 low = cluster.low - margin;
    const vec3 high = cluster.high + margin;
    bool outside = false;
    SHARED_UNROLL for (uint i = 0u; i < 6u; ++i) outside =
        outside || boxOutside(JUDGED.view.planes[i], low, high);
    return !outside && (push.looksForHidden == 0u || !isHidden(low, high));
}

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
