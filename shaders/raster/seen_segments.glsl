// Between which segments of a blade the frame's pyramid does not hide it, asked of some spans and
// without cross-sections, which take longer than the question: of a late pass's segments a twentieth is seen. Never
// less than is seen; those that are left are asked again, one by one (raster_late.comp).
#ifndef SWARD_RASTER_SEEN_SEGMENTS_GLSL
#define SWARD_RASTER_SEEN_SEGMENTS_GLSL

#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/seen_triangle.glsl"

/// What one step of 1 m adds to what seenPoint() says: along the blade's axis, and any way at most.
struct Leverage {
    vec4 axis;
    vec2 squares;  ///< of pixels times w, to the right and downwards
    vec2 products; ///< of those with w
    vec2 ofDepth;  ///< of reversed depth times w, and of w
};

Leverage leverageOf(Lens lens, vec3 axis)
{
    const mat4 m = lens.viewProjection;
    const vec3 w = vec3(m[0].w, m[1].w, m[2].w);
    const vec3 right = 0.5 * lens.size.x * (vec3(m[0].x, m[1].x, m[2].x) + w);
    const vec3 down = 0.5 * lens.size.y * (vec3(m[0].y, m[1].y, m[2].y) + w);
    const vec3 depth = vec3(m[0].z, m[1].z, m[2].z);
    Leverage leverage;
    leverage.axis = vec4(dot(right, axis), dot(down, axis), dot(depth, axis), dot(w, axis));
    leverage.squares = vec2(dot(right, right), dot(down, down));
    leverage.products = vec2(dot(right, w), dot(down, w));
    leverage.ofDepth = vec2(length(depth), length(w));
    return leverage;
}

/// What seenPoint() says of a sum of points more, if this is added to one of them.
vec4 seenWay(Lens lens, vec3 way)
{
    const vec4 clip = mat3x4(lens.viewProjection) * way;
    return vec4((0.5 * clip.xy + 0.5 * clip.w) * lens.size, clip.zw);
}

/// A part of the screen, and the nearest reversed depth in it.
struct SeenBox {
    vec2 low; ///< [pixels]
    vec2 high;
    float nearest;
    vec2 perMetre; ///< by so much it reaches farther for each metre along the blade's axis
};

/// Where everything is seen that lies no farther from a point than `wide` [m] along the blade's axis and
/// then `margin` [m] any way, all of it behind the near plane; `seen`: seenPoint() of it. If x is the
/// point's place and δ the way there, it moves by (right·δ − x·(w·δ)) / w', with w' as w is there. Corners
/// of cross-sections are rounded, by half of 1/256 pixel.
SeenBox boxAround(Leverage leverage, vec4 seen, float wide, float margin)
{
    const vec2 place = seen.xy / seen.w;
    const vec2 square = leverage.squares + place * (place * (leverage.ofDepth.y * leverage.ofDepth.y) -
                                                    2.0 * leverage.products);
    const float perW =
        1.0 / max(seen.w - wide * abs(leverage.axis.w) - margin * leverage.ofDepth.y, 1e-12);
    const vec2 perMetre = perW * abs(leverage.axis.xy - place * leverage.axis.w);
    const vec2 reach = wide * perMetre + (perW * margin) * sqrt(max(square, vec2(0.0))) + 1.0 / 128.0;
    const float nearest = seen.z + wide * abs(leverage.axis.z) + margin * leverage.ofDepth.x;
    return SeenBox(place - reach, place + reach, perW * nearest, perMetre);
}

/// So far [m] the edges of a blade lie from its curve at `t` or anywhere between there and its tip.
float halfWidthFrom(Ribbon ribbon, float t)
{
    if (!isTapering(ribbon.outline.shape))
        return 0.5 * outlineMost * ribbon.width;
    const vec2 edges = edgesAt(ribbon.outline, t);
    return ribbon.width * max(-edges.x, edges.y);
}

/// So many spans of a blade are asked for, each of some segments.
const uint spansTested = 4u;

/// The first segment that may be seen, and one past the last; both 0 where all are hidden. The ribbon's cross-sections
/// are widened by no more than `margin` [m] on either side.
uvec2 segmentsSeen(Lens lens, Ribbon ribbon, float margin)
{
    const Leverage leverage = leverageOf(lens, ribbon.axis);
    const uint segments = uint(ribbon.outline.segments);
    const bool areFew = segments < spansTested;
    const float perSegment = 1.0 / ribbon.outline.segments;
    // The curve from its root on, as it is seen: root + t · (toMiddle + t · bend).
    const vec3 bend = ribbon.v0 - 2.0 * ribbon.v1 + ribbon.v2;
    const vec4 seenRoot = seenPoint(lens, ribbon.v0);
    const vec4 seenMiddle = seenWay(lens, 2.0 * (ribbon.v1 - ribbon.v0));
    const vec4 seenBend = seenWay(lens, bend);
    // A quadratic curve strays from a chord over the part h of it by |v0 - 2 v1 + v2| h²/4 at most.
    const float longest = areFew ? perSegment : float((segments + spansTested - 1u) / spansTested) * perSegment;
    const float stray = 0.25 * longest * longest * length(bend);
    float wide = halfWidthFrom(ribbon, 0.0);
    const float around = margin + stray + (isFolded(ribbon) ? wide * ribbon.fold : 0.0);
    uvec2 seen = uvec2(0u);
    uint begin = 0u;
    SeenBox before = boxAround(leverage, seenRoot, wide, around);
    for (uint i = 1u; i <= min(segments, spansTested); ++i) {
        const uint end = areFew ? i : i * segments / spansTested;
        const float t = float(end) * perSegment;
        // Nowhere in a span it is wider than where that begins.
        const SeenBox after = boxAround(leverage, seenRoot + t * (seenMiddle + t * seenBend), wide, around);
        if (!rectangleHidden(min(before.low, after.low), max(before.high, after.high),
                             max(before.nearest, after.nearest)))
            seen = uvec2(seen.y == 0u ? begin : seen.x, end);
        const float wideAfter = halfWidthFrom(ribbon, t);
        before = after;
        before.low += (wide - wideAfter) * after.perMetre;
        before.high -= (wide - wideAfter) * after.perMetre;
        wide = wideAfter;
        begin = end;
    }
    return seen;
}

#endif
