#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels, one work-group each.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/put_sample.glsl"
#include "shaders/raster/seen_triangle.glsl"

layout(local_size_x = rasterThreads) in;

/// Pixels that a point may be seen in; all of them if it lies before the near plane.
void reach(vec4 point, inout vec2 low, inout vec2 high)
{
    if (point.w <= 0.0 || point.z > point.w) {
        low = vec2(0.0);
        high = vec2(push.size);
    } else {
        low = min(low, point.xy / point.w);
        high = max(high, point.xy / point.w);
    }
}

void largeTriangle(vec4 a, vec4 b, vec4 c, vec2 weightA, vec2 weightB, vec2 weightC, uint blade)
{
    vec2 low = vec2(1e30);
    vec2 high = vec2(-1e30);
    reach(a, low, high);
    reach(b, low, high);
    reach(c, low, high);
    const vec2 edge = vec2(push.size);
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, edge)))
        return;
    const ivec2 first = ivec2(clamp(floor(low), vec2(0.0), edge - 1.0));
    const ivec2 last = ivec2(clamp(floor(high), vec2(0.0), edge - 1.0));
    const uint columns = uint(last.x - first.x + 1);
    const uint pixels = columns * uint(last.y - first.y + 1);
    for (uint i = gl_LocalInvocationIndex; i < pixels; i += rasterThreads) {
        const uvec2 pixel = uvec2(first) + uvec2(i % columns, i / columns);
        uint covered = 0u;
        float depths[samplesPerPixel];
        for (uint s = 0u; s < samplesPerPixel; ++s) {
            const SeenPoint seen = seenAt(a, b, c, vec2(pixel) + samplePlace(s));
            depths[s] = seen.depth;
            if (seen.least >= 0.0 && seen.depth <= 1.0)
                covered |= 1u << s;
        }
        if (covered == 0u)
            continue;
        const vec3 by = seenAt(a, b, c, vec2(pixel) + shadedPlace(covered)).shares;
        covered &= samplesKept(by.x * weightA + by.y * weightB + by.z * weightC, blade);
        for (uint s = 0u; s < samplesPerPixel; ++s)
            if ((covered & (1u << s)) != 0u)
                putSample(pixel, s, depths[s], blade);
    }
}

void largeQuad(vec4 a, vec4 b, vec4 c, vec4 d, Rib before, Rib after, bool isUpper, uint blade)
{
    const vec2 weightBefore = vec2(before.wide, before.drawn);
    const vec2 weightAfter = vec2(after.wide, after.drawn);
    if (isUpper) {
        largeTriangle(a, b, c, weightBefore, weightBefore, weightAfter, blade);
        largeTriangle(b, d, c, weightBefore, weightAfter, weightAfter, blade);
        return;
    }
    largeTriangle(a, b, d, weightBefore, weightBefore, weightAfter, blade);
    largeTriangle(a, d, c, weightBefore, weightAfter, weightAfter, blade);
}

void main()
{
    UintArray large = push.large;
    const uint count = large.at[0];
    const Lens lens = lensOf();
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        const VisibleBlade visible = FRAME.visible.at[large.at[largePlaces + i]];
        const Ribbon ribbon = drawnBlade(visible).ribbon;
        SeenRib a = seenRib(lens, ribbon, 0.0);
        for (float k = 1.0; k <= ribbon.outline.segments; k += 1.0) {
            const SeenRib b = seenRib(lens, ribbon, k / ribbon.outline.segments);
            const bool isUpper = upperHalf(k, ribbon.outline.segments);
            if (ribbon.fold > 0.0) {
                largeQuad(a.left, a.ridge, b.left, b.ridge, a.rib, b.rib, isUpper, visible.blade);
                largeQuad(a.ridge, a.right, b.ridge, b.right, a.rib, b.rib, isUpper, visible.blade);
            } else {
                largeQuad(a.left, a.right, b.left, b.right, a.rib, b.rib, isUpper, visible.blade);
            }
            a = b;
        }
    }
}
