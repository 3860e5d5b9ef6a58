#version 460
#extension GL_GOOGLE_include_directive : require
// Draws large opaque triangles into the visibility, one work-group for each of their tiles.
#include "shaders/shared/passes.h"
#include "shaders/shared/opaque.h"

layout(push_constant, scalar) uniform Block { OpaquePush push; };

#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/preview/draw_opaque.glsl"

layout(local_size_x = opaqueTileThreads) in;

shared uint lastBefore;

/// Finds the triangle of tile `task` among `count` triangles. All threads search together: each step tests one place of
/// the list per thread.
LargeTriangle patchOf(uint task, uint count, uint thread)
{
    uint low = 0u;
    for (uint reach = count; reach > 1u;) {
        const uint stride = (reach + opaqueTileThreads - 1u) / opaqueTileThreads;
        if (thread == 0u)
            lastBefore = low;
        barrier();
        const uint place = low + thread * stride;
        if (thread * stride < reach && push.large.at[place].firstTile <= task)
            atomicMax(lastBefore, place);
        barrier();
        reach = min(stride, low + reach - lastBefore);
        low = lastBefore;
        barrier();
    }
    return push.large.at[low];
}

/// Whether no sample of the tile sees the triangle's front: all corners of the tile, widened by a pixel, lie beyond one
/// side of the triangle.
bool isBeside(OpaqueTriangle triangle, vec2 low)
{
    const vec2 from = low - 1.0;
    const vec2 to = low + float(opaqueTile) + 1.0;
    const vec3 a = areasAt(triangle, from);
    const vec3 b = areasAt(triangle, vec2(to.x, from.y));
    const vec3 c = areasAt(triangle, vec2(from.x, to.y));
    const vec3 d = areasAt(triangle, to);
    const vec3 most = max(max(a, b), max(c, d));
    const vec3 least = min(min(a, b), min(c, d));
    return any(lessThan(most, vec3(0.0))) &&
           (!triangle.isDoubleSided || any(greaterThan(least, vec3(0.0))));
}

void main()
{
    // Not the whole struct: a copy of its arrays would keep their layout, which SPIR-V does not allow.
    const uint tiles = push.work.at[0].tiles.count;
    const uint thread = gl_LocalInvocationIndex;
    const uint triangles = min(push.work.at[0].trianglesAsked, maxLargeTriangles);
    for (uint task = gl_WorkGroupID.x; task < tiles; task += gl_NumWorkGroups.x) {
        const LargeTriangle large = patchOf(task, triangles, thread);
        const uint own = task - large.firstTile;
        const uvec2 tile = uvec2(large.tile & 0xffffu, large.tile >> 16u) +
                           uvec2(own % large.columns, own / large.columns);
        const uvec2 low = tile * opaqueTile;
        const OpaqueTriangle triangle = opaqueTriangle(large.triangle);
        if (isBeside(triangle, vec2(low)))
            continue;
        const uvec2 end = min(low + opaqueTile, push.size);
        // Neighbouring threads draw neighbouring samples.
        const uint samplesOfColumn = opaqueTile * samplesPerPixel;
        for (uint i = thread; i < samplesOfColumn * opaqueTile; i += opaqueTileThreads) {
            const uvec2 pixel = low + uvec2(i / samplesOfColumn, i % samplesOfColumn / samplesPerPixel);
            if (all(lessThan(pixel, end)))
                drawSample(triangle, large.triangle, pixel, i % samplesPerPixel);
        }
    }
}
