#version 460
#extension GL_GOOGLE_include_directive : require
// Draws large triangles of what is solid into the visibility, a work-group for each of their tiles.
#include "shaders/shared/passes.h"
#include "shaders/shared/solid.h"

layout(push_constant, scalar) uniform Block { SolidPush push; };

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/solid/draw_solid.glsl"

layout(local_size_x = solidTileThreads) in;

shared uint lastBefore;

/// The triangle to which a tile of all belongs, of `count`: all threads look together, at as many places
/// of the list at a time as they are.
LargeTriangle ownerOf(uint task, uint count, uint thread)
{
    uint low = 0u;
    for (uint reach = count; reach > 1u;) {
        const uint stride = (reach + solidTileThreads - 1u) / solidTileThreads;
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

/// Whether none of the tile's samples sees the triangle's front: one of its sides has all corners of
/// the tile, a pixel wider than it is, beyond it.
bool isBeside(SolidTriangle triangle, vec2 low)
{
    const vec2 from = low - 1.0;
    const vec2 to = low + float(solidTile) + 1.0;
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
    const SolidWork work = push.work.at[0];
    const uint thread = gl_LocalInvocationIndex;
    const uint triangles = min(work.trianglesAsked, maxLargeTriangles);
    for (uint task = gl_WorkGroupID.x; task < work.tiles.count; task += gl_NumWorkGroups.x) {
        const LargeTriangle large = ownerOf(task, triangles, thread);
        const uint own = task - large.firstTile;
        const uvec2 tile = uvec2(large.tile & 0xffffu, large.tile >> 16u) +
                           uvec2(own % large.columns, own / large.columns);
        const uvec2 low = tile * solidTile;
        const SolidTriangle triangle = solidTriangle(large.triangle);
        if (isBeside(triangle, vec2(low)))
            continue;
        const uvec2 end = min(low + solidTile, push.size);
        // Threads beside one another draw samples that lie together.
        const uint samplesOfColumn = solidTile * samplesPerPixel;
        for (uint i = thread; i < samplesOfColumn * solidTile; i += solidTileThreads) {
            const uvec2 pixel = low + uvec2(i / samplesOfColumn, i % samplesOfColumn / samplesPerPixel);
            if (all(lessThan(pixel, end)))
                drawSample(triangle, large.triangle, pixel, i % samplesPerPixel);
        }
    }
}
