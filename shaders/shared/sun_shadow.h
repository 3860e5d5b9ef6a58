// The shadow of the ground. docs/decisions/0020-a-shadow-map-of-the-ground.md
#ifndef SWARD_SHARED_SUN_SHADOW_H
#define SWARD_SHARED_SUN_SHADOW_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_TABLE(SunDepthTable, float)

/// The ground in the sun's view: an orthographic map of the surface nearest to the sun. Positions
/// are relative to the field's origin.
struct SunShadow {
    SunDepthTable depths; ///< size · size, 1 nearest to the sun, 0 farthest
    vec4 across;          ///< dot(across, (place, 1)): pixel of the map, from its first edge
    vec4 down;
    vec4 depth;    ///< dot(depth, (place, 1)): depth as in the map
    uint size;     ///< pixels along an edge; 0: no shadow
    float texel;   ///< [m] longer edge of a pixel
    float epsilon; ///< depth by which an occluder must be nearer
    uint reserved;
};
SHARED_LAYOUT(SunShadow, 72)

/// A place is tested this many pixels above its ground, so that ground does not shade itself. The
/// four pixels below lie within 1.42 of it, and ground at any slope rises less than that over them,
/// measured along its normal; the rest is for curved ground.
SHARED_CONST float shadowOffset = 2.0f;

/// Share of the sun's disc that is visible from a place on ground with this unit normal, [0, 1]:
/// the four pixels around it, weighted by nearness, so that a shadow's edge is a pixel wide.
SHARED_FN float sunSeen(SunShadow shadow, vec3 place, vec3 normal)
{
    if (shadow.size == 0u)
        return 1.0f;
    const vec4 lifted = vec4(place + normal * (shadowOffset * shadow.texel), 1.0f);
    // Depths are those of pixel centres.
    const vec2 at = vec2(dot(shadow.across, lifted), dot(shadow.down, lifted)) - 0.5f;
    const float depth = dot(shadow.depth, lifted) + shadow.epsilon;

    const vec2 f = at - floor(at);
    const int last = int(shadow.size) - 2;
    const int column = clamp(int(floor(at.x)), 0, last);
    const int row = clamp(int(floor(at.y)), 0, last);
    const int first = row * int(shadow.size) + column;
    const int below = first + int(shadow.size);
    const float above0 = shadow.depths.at[first] > depth ? 1.0f : 0.0f;
    const float above1 = shadow.depths.at[first + 1] > depth ? 1.0f : 0.0f;
    const float below0 = shadow.depths.at[below] > depth ? 1.0f : 0.0f;
    const float below1 = shadow.depths.at[below + 1] > depth ? 1.0f : 0.0f;
    return 1.0f - mix(mix(above0, above1, f.x), mix(below0, below1, f.x), f.y);
}

SHARED_END
#endif
