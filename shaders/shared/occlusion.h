// Occlusion by the ground: a pyramid of the farthest depths on the screen, and boxes behind it.
// Greene, Kass & Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993.
#ifndef SWARD_SHARED_OCCLUSION_H
#define SWARD_SHARED_OCCLUSION_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_BUFFER(DepthArray, float, )

/// A cell of a level covers 4 × 4 cells of the level below, at level 0 4 × 4 pixels. It holds the
/// smallest reversed depth there: everything behind this depth is hidden in all of them.
SHARED_CONST uint pyramidFactorBits = 2u;

/// Enough to reduce 16 384 pixels to one cell.
SHARED_CONST uint maxPyramidLevels = 7u;

struct DepthPyramid {
    DepthArray depths;            ///< by level, then by row; address 0: none
    uvec2 size;                   ///< [pixels] of the picture
    uint first[maxPyramidLevels]; ///< first cell of each level
    uint levels;
};
SHARED_LAYOUT(DepthPyramid, 48)

/// Cells of a level along an axis with `pixels` pixels.
SHARED_FN uint pyramidCells(uint pixels, uint level)
{
    const uint bits = pyramidFactorBits * (level + 1u);
    return max((pixels + (1u << bits) - 1u) >> bits, 1u);
}

/// A box on the screen.
struct ScreenBox {
    ivec2 low; ///< [pixels] inclusive bounds
    ivec2 high;
    float nearest; ///< its largest reversed depth
    bool isKnown;  ///< false: it reaches through the near plane, other fields are not valid
};

/// The screen box of a box in space, on a picture of `size` pixels. It contains the projection of
/// all points of the box, and one more pixel on each side for samples beside pixel centres.
SHARED_FN ScreenBox screenBoxOf(mat4 viewProjection, uvec2 size, vec3 low, vec3 high)
{
    ScreenBox box;
    vec2 lowest = vec2(1e30f);
    vec2 highest = vec2(-1e30f);
    box.nearest = 0.0f;
    box.isKnown = true;
    for (uint i = 0u; i < 8u; ++i) {
        const vec4 corner = vec4((i & 1u) != 0u ? high.x : low.x, (i & 2u) != 0u ? high.y : low.y,
                                 (i & 4u) != 0u ? high.z : low.z, 1.0f);
        const vec4 clip = viewProjection * corner;
        if (!(clip.w > 0.0f) || clip.z > clip.w) {
            box.isKnown = false;
            box.low = ivec2(0);
            box.high = ivec2(0);
            return box;
        }
        const vec2 place = vec2(clip.x, clip.y) / clip.w;
        lowest = min(lowest, place);
        highest = max(highest, place);
        box.nearest = max(box.nearest, clip.z / clip.w);
    }
    const vec2 pixels = vec2(float(size.x), float(size.y));
    const vec2 last = pixels - vec2(1.0f);
    lowest = clamp(floor((lowest * 0.5f + vec2(0.5f)) * pixels) - vec2(1.0f), vec2(0.0f), last);
    highest = clamp(floor((highest * 0.5f + vec2(0.5f)) * pixels) + vec2(1.0f), vec2(0.0f), last);
    box.low = ivec2(int(lowest.x), int(lowest.y));
    box.high = ivec2(int(highest.x), int(highest.y));
    return box;
}

/// The first three entries of row `i` of a matrix: the factors of a direction.
SHARED_FN vec3 rowOf(mat4 m, int i)
{
    return vec3(m[0][i], m[1][i], m[2][i]);
}

/// The same for all points within `margin` [m] of a quadratic Bézier curve over v0, v1, v2. Faster,
/// and tighter around a bent blade. While all weights are positive, the projected curve lies
/// between its projected control points. A place x moves by (row_x·δ − x·(row_w·δ)) / w' if its
/// point moves by δ.
SHARED_FN ScreenBox screenBoxOfCurve(mat4 viewProjection, uvec2 size, vec3 v0, vec3 v1, vec3 v2,
                                     float margin)
{
    const vec4 a = viewProjection * vec4(v0, 1.0f);
    const vec4 b = viewProjection * vec4(v1, 1.0f);
    const vec4 c = viewProjection * vec4(v2, 1.0f);
    const float ofW = length(rowOf(viewProjection, 3));
    const float minW = min(min(a.w, b.w), c.w) - margin * ofW;
    const float maxZ = max(max(a.z, b.z), c.z) + margin * length(rowOf(viewProjection, 2));
    ScreenBox box;
    box.low = ivec2(0);
    box.high = ivec2(0);
    box.nearest = 0.0f;
    box.isKnown = minW > 0.0f && maxZ <= minW;
    if (!box.isKnown)
        return box;
    const vec2 placeA = vec2(a.x, a.y) * (1.0f / a.w);
    const vec2 placeB = vec2(b.x, b.y) * (1.0f / b.w);
    const vec2 placeC = vec2(c.x, c.y) * (1.0f / c.w);
    vec2 lowest = min(min(placeA, placeB), placeC);
    vec2 highest = max(max(placeA, placeB), placeC);
    const vec2 ofPlace = vec2(length(rowOf(viewProjection, 0)), length(rowOf(viewProjection, 1)));
    const float perW = 1.0f / minW;
    const vec2 reach = (ofPlace + max(abs(lowest), abs(highest)) * ofW) * (margin * perW);
    const vec2 pixels = vec2(float(size.x), float(size.y));
    const vec2 last = pixels - vec2(1.0f);
    lowest = floor(((lowest - reach) * 0.5f + vec2(0.5f)) * pixels) - vec2(1.0f);
    highest = floor(((highest + reach) * 0.5f + vec2(0.5f)) * pixels) + vec2(1.0f);
    box.low = ivec2(clamp(lowest, vec2(0.0f), last));
    box.high = ivec2(clamp(highest, vec2(0.0f), last));
    box.nearest = maxZ * perW;
    return box;
}

/// Maximum number of cells along an axis that are read for one box.
SHARED_CONST int pyramidReach = 4;

/// The finest level at which a box touches at most pyramidReach cells along each axis, or the
/// coarsest of `levels`.
SHARED_FN uint pyramidLevelFor(ScreenBox box, uint levels)
{
    // A box with an extent below n cells touches at most n + 1 cells.
    const int extent = max(box.high.x - box.low.x, box.high.y - box.low.y);
    const uint level = uint(max(findMSB(extent) - 2, 0)) / pyramidFactorBits;
    const uint bits = pyramidFactorBits * (level + 1u);
    const bool fits = (box.high.x >> bits) - (box.low.x >> bits) < pyramidReach &&
                      (box.high.y >> bits) - (box.low.y >> bits) < pyramidReach;
    return min(fits ? level : level + 1u, levels - 1u);
}

SHARED_END
#endif
