// Whether a cluster of the ground may be visible in the frame CULL_VIEW.
#ifndef SWARD_PREVIEW_CLUSTER_SEEN_GLSL
#define SWARD_PREVIEW_CLUSTER_SEEN_GLSL

bool clusterSeen(GroundCluster cluster)
{
    // Planes and places are rounded; a hundred-thousandth of the distance exceeds both errors.
    const vec3 eye = CULL_VIEW.view.eye;
    const vec3 farthest = max(abs(cluster.low - eye), abs(cluster.high - eye));
    const vec3 margin = vec3(1e-5 * length(farthest));
    const vec3 low = cluster.low - margin;
    const vec3 high = cluster.high + margin;
    bool outside = false;
    SHARED_UNROLL for (uint i = 0u; i < 6u; ++i) outside =
        outside || boxOutside(CULL_VIEW.view.planes[i], low, high);
    return !outside;
}

#endif
