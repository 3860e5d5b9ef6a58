// Triangles that may reach through the near plane, clipped there.
#ifndef SWARD_RASTER_NEAR_CUT_GLSL
#define SWARD_RASTER_NEAR_CUT_GLSL

#include "shaders/raster/screen_section.glsl"

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

#endif
