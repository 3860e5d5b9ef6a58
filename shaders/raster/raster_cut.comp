#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises blades that may reach through the near plane, one work-group each, and clips them there. On a CPU also
// those that cover too many pixels for a thread. They are few: every thread builds all triangles and draws some rows.
#include "shaders/shared/passes.h"

#ifdef HAS_INSTANCES
#include "shaders/raster/instances.glsl"
#else
layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#endif
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/span.glsl"

layout(local_size_x = largeThreads) in;

/// A corner of a triangle that may reach through the near plane.
struct Corner {
    vec4 seen;
    vec2 widths; ///< CrossSection::wide, CrossSection::drawn
};

/// The intersection of an edge with the near plane. One of its ends lies before the plane.
Corner cutBetween(Corner a, Corner b)
{
    const float depthA = a.seen.w - a.seen.z;
    const float depthB = b.seen.w - b.seen.z;
    const float share = depthA / (depthA - depthB);
    return Corner(mix(a.seen, b.seen, share), mix(a.widths, b.widths, share));
}

/// The part of a triangle that lies behind the near plane; false if it is empty.
bool behindNear(Corner a, Corner b, Corner c, out Quad quad)
{
    const uint lost = uint(isBefore(a.seen)) + uint(isBefore(b.seen)) + uint(isBefore(c.seen));
    if (lost == 3u)
        return false;
    // The first corner is the one that is alone on its side.
    const bool isLost = lost == 1u;
    Corner first = a;
    Corner second = b;
    Corner third = c;
    if (isBefore(b.seen) == isLost && lost > 0u) {
        first = b;
        second = c;
        third = a;
    } else if (isBefore(c.seen) == isLost && lost > 0u) {
        first = c;
        second = a;
        third = b;
    }
    Corner fourth = third;
    if (lost == 1u) {
        fourth = cutBetween(first, third);
        first = cutBetween(first, second);
    } else if (lost == 2u) {
        second = cutBetween(first, second);
        third = cutBetween(first, third);
        fourth = third;
    }
    quad.a0 = screenPoint(first.seen);
    quad.a1 = screenPoint(second.seen);
    quad.b1 = screenPoint(third.seen);
    quad.b0 = screenPoint(fourth.seen);
    quad.weightA0 = first.widths / first.seen.w;
    quad.weightA1 = second.widths / second.seen.w;
    quad.weightB = 0.5 * (third.widths / third.seen.w + fourth.widths / fourth.seen.w);
    return true;
}

/// The part of one triangle between two cross-sections that lies behind the near plane; false if it is empty.
bool triangleBehindNear(uint i, SeenSection before, SeenSection after, bool isFolded, bool isUpper, out Quad quad)
{
    const TriangleOf part = triangleOf(i, isFolded, isUpper);
    const vec2 first = vec2(before.section.wide, before.section.drawn);
    const vec2 second = vec2(after.section.wide, after.section.drawn);
    const Corner a = Corner(part.isRight ? before.ridge : before.left, first);
    const Corner b = Corner(part.endsAtRidge ? before.ridge : before.right, first);
    const Corner c = Corner(part.isRight ? after.ridge : after.left, second);
    const Corner d = Corner(part.endsAtRidge ? after.ridge : after.right, second);
    return behindNear(part.beginsRight ? b : a, part.isSecond ? d : b, part.endsLeft ? c : d, quad);
}

void main()
{
#ifdef HAS_INSTANCES
    beginInstances();
#endif
    LargePartArray cut = push.cut;
    const uint count = min(push.largeCount.at[largeCut].count, maxCutBlades);
#ifndef HAS_INSTANCES
    const Lens lens = lensOf();
#endif
    for (uint item = gl_WorkGroupID.x; item < count; item += gl_NumWorkGroups.x) {
        const LargePart blade = cut.at[item];
#ifdef HAS_INSTANCES
        chooseInstance(blade.instance);
        const Lens lens = lensOf();
#endif
        const Ribbon ribbon = ribbonOf(blade);
        const float segments = ribbon.outline.segments;
        const bool hasRidge = isFolded(ribbon);
        for (float segment = 1.0; segment <= segments; segment += 1.0) {
            const SeenSection before = seenSection(lens, ribbon, (segment - 1.0) / segments);
            const SeenSection after = seenSection(lens, ribbon, segment / segments);
            for (uint i = 0u; i < trianglesOf(hasRidge); ++i) {
                Quad quad;
                Span span;
                if (!triangleBehindNear(i, before, after, hasRidge, upperHalf(segment, segments), quad) ||
                    !spanOfQuad(quad, isThin(quad), span))
                    continue;
                const vec2 ends = vec2(min(min(quad.a0.y, quad.a1.y), min(quad.b0.y, quad.b1.y)),
                                       max(max(quad.a0.y, quad.a1.y), max(quad.b0.y, quad.b1.y)));
                const ivec2 rows = rowsBetween(ends.x, ends.y, float(push.size.y));
                for (int row = rows.x + int(gl_LocalInvocationIndex); row <= rows.y; row += int(largeThreads))
                    drawRow(span, blade.blade, ribbon.seed, row);
            }
        }
    }
}
