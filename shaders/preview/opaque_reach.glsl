// The part of the picture that an opaque triangle may touch.
#ifndef SWARD_PREVIEW_OPAQUE_REACH_GLSL
#define SWARD_PREVIEW_OPAQUE_REACH_GLSL

#include "shaders/preview/opaque_triangle.glsl"

/// Whether a corner lies before the near plane or behind the eye.
bool isBefore(vec4 corner)
{
    return corner.w <= 0.0 || corner.z > corner.w;
}

/// A rectangle of the picture; empty if `low` is not below `high`.
struct Reach {
    vec2 low;
    vec2 high;
};

void include(inout Reach reach, vec4 corner)
{
    const vec2 place = corner.xy / max(corner.w, 1e-30);
    reach.low = min(reach.low, place);
    reach.high = max(reach.high, place);
}

/// Includes the part of a side that lies behind the near plane.
void includeSide(inout Reach reach, vec4 from, vec4 to)
{
    const float fromBefore = from.z - from.w;
    const float toBefore = to.z - to.w;
    if (fromBefore <= 0.0)
        include(reach, from);
    if ((fromBefore <= 0.0) != (toBefore <= 0.0))
        include(reach, mix(from, to, fromBefore / (fromBefore - toBefore)));
}

/// The pixels whose samples the triangle may cover: the first and the last pixel along each axis.
ivec4 pixelsOf(OpaqueTriangle triangle)
{
    const bvec3 before = bvec3(isBefore(triangle.a), isBefore(triangle.b), isBefore(triangle.c));
    if (all(before))
        return ivec4(0, 0, -1, -1);
    Reach reach = Reach(vec2(1e30), vec2(-1e30));
    // Bound of the rounding error; much larger for places near the eye.
    float slack = 1.0 / 256.0;
    if (any(before)) {
        includeSide(reach, triangle.a, triangle.b);
        includeSide(reach, triangle.b, triangle.c);
        includeSide(reach, triangle.c, triangle.a);
        slack = 1.0;
    } else {
        include(reach, triangle.a);
        include(reach, triangle.b);
        include(reach, triangle.c);
    }
    const float first = samplesPerPixel == 1u ? 0.5 : 0.125;
    const vec2 edge = vec2(push.size);
    const vec2 low = clamp(ceil(reach.low - (1.0 - first) - slack), vec2(0.0), edge);
    const vec2 high = clamp(floor(reach.high - first + slack), vec2(-1.0), edge - 1.0);
    return ivec4(ivec2(low), ivec2(high));
}

#endif
