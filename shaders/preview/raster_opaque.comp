#version 460
#extension GL_GOOGLE_include_directive : require
// Draws small opaque triangles into the visibility, one thread each. Lists the others for raster_middle_opaque.comp and
// raster_large_opaque.comp.
#include "shaders/shared/constants.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/opaque.h"

layout(push_constant, scalar) uniform Block { OpaquePush push; };

#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#define CULL_VIEW FRAME
#include "shaders/preview/cluster_seen.glsl"
#include "shaders/preview/draw_opaque.glsl"
#include "shaders/preview/opaque_reach.glsl"

layout(local_size_x = opaqueThreads) in;

/// An OpaqueWork as words of 64 bits.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer TicketArray
{
    uint64_t at[];
};

// Whether these are triangles of colliders; known at pipeline creation.
layout(constant_id = idIsOfColliders) const bool isOfColliders = false;

// Potentially visible clusters of the work-group, in any order: depths and numbers decide the visibility, not the draw
// order.
shared uint seenClusters[opaqueThreads];
shared uint seenCount;

/// Lists a triangle for a team; returns whether there was room.
bool leftToTeam(uint number)
{
    OpaqueWorkArray work = push.work;
    const uint slot = atomicAdd(work.at[0].middle.count, 1u);
    if (slot >= maxMiddleTriangles)
        return false;
    UintArray middle = push.middle;
    middle.at[slot] = number;
    atomicMax(work.at[0].middle.groups[0], min(slot / teamsOfGroup + 1u, maxGroups));
    return true;
}

/// Lists a triangle for work-groups; returns whether there was room.
bool leftToGroups(uint number, uvec4 pixels)
{
    const uvec2 first = pixels.xy / opaqueTile;
    const uvec2 tiles = pixels.zw / opaqueTile - first + 1u;
    // One atomic counts triangles and tiles, so that the list is in the order of the tiles.
    TicketArray tickets = TicketArray(uvec2(push.work));
    const uint64_t ticket =
        atomicAdd(tickets.at[ticketPlace], (uint64_t(1u) << 32u) | uint64_t(tiles.x * tiles.y));
    const uint slot = uint(ticket >> 32u);
    if (slot >= maxLargeTriangles)
        return false;
    LargeTriangleArray large = push.large;
    OpaqueWorkArray work = push.work;
    large.at[slot] = LargeTriangle(number, uint(ticket), first.x | (first.y << 16u), tiles.x);
    const uint listed = uint(ticket) + tiles.x * tiles.y;
    atomicMax(work.at[0].tiles.count, listed);
    atomicMax(work.at[0].tiles.groups[0], min(listed, maxGroups));
    return true;
}

void rasterise(uint number, OpaqueTriangle triangle)
{
    const ivec4 pixels = pixelsOf(triangle);
    const ivec2 size = pixels.zw - pixels.xy + 1;
    if (any(lessThan(size, ivec2(1))))
        return;
    const uint inFront = uint(size.x) * uint(size.y);
    if (inFront > middleOpaquePixels && leftToGroups(number, uvec4(pixels)))
        return;
    if (inFront > smallOpaquePixels && leftToTeam(number))
        return;
    for (int y = pixels.y; y <= pixels.w; ++y)
        for (int x = pixels.x; x <= pixels.z; ++x)
            drawPixel(triangle, number, uvec2(x, y));
}

void main()
{
    if (isOfColliders) {
        for (uint i = gl_GlobalInvocationID.x; i < push.triangleCount;
             i += gl_NumWorkGroups.x * opaqueThreads)
            rasterise(groundTriangles() + i, colliderTriangle(i));
        return;
    }
    const uint thread = gl_LocalInvocationIndex;
    // Neighbouring clusters are often visible together, so different groups take them.
    const uint stride = gl_NumWorkGroups.x;
    for (uint first = gl_WorkGroupID.x; first < push.clusterCount; first += stride * opaqueThreads) {
        if (thread == 0u)
            seenCount = 0u;
        barrier();
        const uint candidate = first + thread * stride;
        if (candidate < push.clusterCount && clusterSeen(push.clusters.at[candidate]))
            seenClusters[atomicAdd(seenCount, 1u)] = candidate;
        barrier();
        for (uint i = 0u; i < seenCount; ++i) {
            const uint cluster = seenClusters[i];
            if (thread < push.clusters.at[cluster].indexCount / 3u) {
                const uint number = cluster * clusterTriangles + thread;
                rasterise(number, groundTriangle(number));
            }
        }
        barrier();
    }
}
