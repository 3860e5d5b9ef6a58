// Finds the segments of a blade that the frame's pyramid does not hide. Tests a few spans without cross-sections, which
// cost more than the test: a twentieth of a late pass's segments is visible. The result is conservative;
// raster_late.comp tests the remaining segments one by one.
#ifndef SWARD_RASTER_SEEN_SEGMENTS_GLSL
#define SWARD_RASTER_SEEN_SEGMENTS_GLSL

#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/seen_triangle.glsl"

/// Change of seenPoint() per step of 1 m: along the blade's axis, and the maximum over all directions.
struct Leverage {
    vec4 axis;
    vec2 squares;  ///< of pixels times w, to the right and down
    vec2 products; ///< of these with w
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

/// Change of seenPoint() if `way` is added to the point.
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
    vec2 perMetre; ///< growth per metre along the blade's axis
};

/// Bounds of all points within `wide` [m] along the blade's axis plus `margin` [m] in any direction of a point, all
/// behind the near plane; `seen`: seenPoint() of it. If x is the point's place and δ the offset, x moves by (right·δ −
/// x·(w·δ)) / w', with w' at the moved point. Corners of cross-sections are rounded, by half of 1/256 pixel.
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

/// Maximum distance [m] of a blade's edges from its curve between `t` and the tip.
float halfWidthFrom(Ribbon ribbon, float t)
{
    if (!isTapering(ribbon.outline.shape))
        return 0.5 * outlineMost * ribbon.width;
    const vec2 edges = edgesAt(ribbon.outline, t);
    return ribbon.width * max(-edges.x, edges.y);
}

/// Maximum number of spans of a blade that are tested, each of some segments.
const uint spansTested = 4u;

/// The first potentially visible segment, and one past the last; both 0 if all are hidden. Cross-sections are widened
/// by at most `margin` [m] on either side.
uvec2 segmentsSeen(Lens lens, Ribbon ribbon, float margin)
{
    const Leverage leverage = leverageOf(lens, ribbon.axis);
    const uint segments = uint(ribbon.outline.segments);
    const bool areFew = segments < spansTested;
    const float perSegment = 1.0 / ribbon.outline.segments;
    // The curve from its root on, projected: root + t · (toMiddle + t · bend).
    const vec3 bend = ribbon.v0 - 2.0 * ribbon.v1 + ribbon.v2;
    const vec4 seenRoot = seenPoint(lens, ribbon.v0);
    const vec4 seenMiddle = seenWay(lens, 2.0 * (ribbon.v1 - ribbon.v0));
    const vec4 seenBend = seenWay(lens, bend);
    // A quadratic curve deviates from a chord over a part h of it by at most |v0 - 2 v1 + v2| h²/4.
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
        // A span is widest at its begin.
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
