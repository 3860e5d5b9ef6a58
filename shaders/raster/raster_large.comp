#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels, one work-group each.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/screen_triangle.glsl"

layout(local_size_x = rasterThreads) in;

/// Widens the pixels between `low` and `high` by those in which an edge is seen behind the near
/// plane.
void reach(vec4 a, vec4 b, inout vec2 low, inout vec2 high)
{
    const float depthA = a.w - a.z;
    const float depthB = b.w - b.z;
    if (depthA < 0.0 && depthB < 0.0)
        return;
    const float cut = depthA / (depthA - depthB);
    const vec4 from = depthA < 0.0 ? mix(a, b, cut) : a;
    const vec4 to = depthB < 0.0 ? mix(a, b, cut) : b;
    low = min(low, min(from.xy / from.w, to.xy / to.w));
    high = max(high, max(from.xy / from.w, to.xy / to.w));
}

/// A triangle of which a part may lie before the near plane.
void cutTriangle(vec4 a, vec4 b, vec4 c, vec2 weightA, vec2 weightB, vec2 weightC, uint blade,
                 Rows rows)
{
    vec2 low = vec2(1e30);
    vec2 high = vec2(-1e30);
    reach(a, b, low, high);
    reach(b, c, low, high);
    reach(c, a, low, high);
    const vec2 edge = vec2(push.size);
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, edge)))
        return;
    const ivec2 first = ivec2(clamp(floor(low), vec2(0.0), edge - 1.0));
    const ivec2 last = ivec2(clamp(floor(high), vec2(0.0), edge - 1.0));
    const uint columns = uint(last.x - first.x + 1);
    const uint pixels = columns * uint(last.y - first.y + 1);
    for (uint i = uint(rows.first); i < pixels; i += uint(rows.step_)) {
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

void cutQuad(vec4 a, vec4 b, vec4 c, vec4 d, Rib before, Rib after, bool isUpper, uint blade,
             Rows rows)
{
    const vec2 first = vec2(before.wide, before.drawn);
    const vec2 second = vec2(after.wide, after.drawn);
    if (isUpper) {
        cutTriangle(a, b, c, first, first, second, blade, rows);
        cutTriangle(b, d, c, first, second, second, blade, rows);
    } else {
        cutTriangle(a, b, d, first, first, second, blade, rows);
        cutTriangle(a, d, c, first, second, second, blade, rows);
    }
}

void main()
{
    UintArray large = push.large;
    const uint count = min(large.at[largeAsked], mostLargeBlades);
    const Lens lens = lensOf();
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        const VisibleBlade visible = FRAME.visible.at[large.at[largePlaces + i]];
        const Ribbon ribbon = drawnBlade(visible).ribbon;
        const bool isFolded = ribbon.fold > 0.0;

        // The threads share the segments, and those of a segment its rows.
        const uint segments = uint(ribbon.outline.segments);
        const uint perSegment = rasterThreads / segments;
        const uint segment = gl_LocalInvocationIndex / perSegment;
        if (segment >= segments)
            continue;
        const Rows rows = Rows(int(gl_LocalInvocationIndex % perSegment), int(perSegment));
        const SeenRib a = seenRib(lens, ribbon, float(segment) / ribbon.outline.segments);
        const SeenRib b = seenRib(lens, ribbon, float(segment + 1u) / ribbon.outline.segments);
        const bool isUpper = upperHalf(float(segment + 1u), ribbon.outline.segments);
        if (isLost(a) && isLost(b))
            continue;
        if (!isCut(a) && !isCut(b)) {
            screenSegment(screenRib(a), screenRib(b), isFolded, isUpper, visible.blade, rows);
        } else if (isFolded) {
            cutQuad(a.left, a.ridge, b.left, b.ridge, a.rib, b.rib, isUpper, visible.blade, rows);
            cutQuad(a.ridge, a.right, b.ridge, b.right, a.rib, b.rib, isUpper, visible.blade, rows);
        } else {
            cutQuad(a.left, a.right, b.left, b.right, a.rib, b.rib, isUpper, visible.blade, rows);
        }
    }
}
