#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels: each by a team of threads, or by several teams.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/strip.glsl"

layout(local_size_x = largeThreads) in;

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
        const vec3 by = seenAt(a, b, c, vec2(pixel) + middleOf(covered)).shares;
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

const uint teamsOfGroup = largeThreads / teamThreads;
const uint teamRibs = teamSegments + 1u;

/// A rib, as the threads of a team share it.
struct SharedRib {
    vec4 left;
    vec4 right;
    vec4 ridge;
    vec2 widths; ///< Rib::wide, Rib::drawn
};

shared SharedRib ribs[teamsOfGroup * teamRibs];
shared uint mostSegments;

SeenRib fromShared(SharedRib rib)
{
    SeenRib seen;
    seen.left = rib.left;
    seen.right = rib.right;
    seen.ridge = rib.ridge;
    seen.rib.wide = rib.widths.x;
    seen.rib.drawn = rib.widths.y;
    return seen;
}

void drawSegment(SeenRib a, SeenRib b, bool isFolded, bool isUpper, uint blade, Rows rows)
{
    if (isLost(a) && isLost(b))
        return;
    if (!isCut(a) && !isCut(b)) {
        screenSegment(screenRib(a), screenRib(b), isFolded, isUpper, blade, rows);
    } else if (isFolded) {
        cutQuad(a.left, a.ridge, b.left, b.ridge, a.rib, b.rib, isUpper, blade, rows);
        cutQuad(a.ridge, a.right, b.ridge, b.right, a.rib, b.rib, isUpper, blade, rows);
    } else {
        cutQuad(a.left, a.right, b.left, b.right, a.rib, b.rib, isUpper, blade, rows);
    }
}

void main()
{
    LargePartArray large = push.large;
    const uint count = min(push.largeCount.at[0].count, mostLargeParts);
    const Lens lens = lensOf();
    const uint team = gl_LocalInvocationIndex / teamThreads;
    const uint member = gl_LocalInvocationIndex % teamThreads;
    for (uint base = gl_WorkGroupID.x * teamsOfGroup; base < count;
         base += gl_NumWorkGroups.x * teamsOfGroup) {
        LargePart part;
        part.parts = 0u;
        if (base + team < count)
            part = large.at[base + team];
        const bool draws = part.parts > 0u;
        Ribbon ribbon;
        uint segments = 0u;
        if (draws) {
            ribbon = drawnBlade(part.visible).ribbon;
            segments = uint(ribbon.outline.segments);
        }
        if (gl_LocalInvocationIndex == 0u)
            mostSegments = 0u;
        barrier();
        if (member == 0u)
            atomicMax(mostSegments, segments);
        barrier();

        for (uint first = 0u; first < mostSegments; first += teamSegments) {
            // Each member makes some of the ribs, then draws some of the rows of every segment.
            const uint last = min(first + teamSegments, segments);
            for (uint i = first + member; draws && i <= last; i += teamThreads) {
                const SeenRib seen = seenRib(lens, ribbon, float(i) / ribbon.outline.segments);
                ribs[team * teamRibs + i - first] = SharedRib(
                    seen.left, seen.right, seen.ridge, vec2(seen.rib.wide, seen.rib.drawn));
            }
            barrier();
            for (uint i = first; i < last; ++i)
                drawSegment(fromShared(ribs[team * teamRibs + i - first]),
                            fromShared(ribs[team * teamRibs + i - first + 1u]), ribbon.fold > 0.0,
                            upperHalf(float(i + 1u), ribbon.outline.segments), part.visible.blade,
                            Rows(int(part.part * teamThreads + member),
                                 int(part.parts * teamThreads)));
            barrier();
        }
    }
}
