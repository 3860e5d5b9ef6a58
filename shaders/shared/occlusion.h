// What the ground hides: a pyramid of the farthest depths on the screen, and boxes behind it.
// Greene, Kass & Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993.
#ifndef SWARD_SHARED_OCCLUSION_H
#define SWARD_SHARED_OCCLUSION_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_BUFFER(DepthArray, float, )

/// Each cell of a level stands for 4 × 4 of the level below, those of level 0 for 4 × 4 pixels, and
/// holds the smallest reversed depth there: nothing behind it is seen in any of them.
SHARED_CONST uint pyramidFactorBits = 2u;

/// 16 384 pixels end at one cell.
SHARED_CONST uint maxPyramidLevels = 7u;

struct DepthPyramid {
    DepthArray depths;            ///< level after level, row after row; address 0: none
    uvec2 size;                   ///< [pixels] of the picture
    uint first[maxPyramidLevels]; ///< where each level begins
    uint levels;
};
SHARED_LAYOUT(DepthPyramid, 48)

/// Cells of a level along an axis of so many pixels.
SHARED_FN uint pyramidCells(uint pixels, uint level)
{
    const uint bits = pyramidFactorBits * (level + 1u);
    return max((pixels + (1u << bits) - 1u) >> bits, 1u);
}

/// A box on the screen.
struct ScreenBox {
    ivec2 low; ///< [pixels] that it may touch, bounds included
    ivec2 high;
    float nearest; ///< largest reversed depth of it
    bool isKnown;  ///< false: it reaches behind the near plane, and nothing is said
};

/// Where a box of space lies on a picture of `size` pixels. Everything inside projects into the
/// pixels from low to high, with one more around for samples beside the middle of a pixel.
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

/// Cells along an axis that are looked at for one box, at most.
SHARED_CONST int pyramidReach = 4;

/// The finest level at which a box touches at most pyramidReach cells along each axis.
SHARED_FN uint pyramidLevelFor(ScreenBox box, uint levels)
{
    uint level = 0u;
    for (; level + 1u < levels; ++level) {
        const uint bits = pyramidFactorBits * (level + 1u);
        if ((box.high.x >> bits) - (box.low.x >> bits) < pyramidReach &&
            (box.high.y >> bits) - (box.low.y >> bits) < pyramidReach)
            break;
    }
    return level;
}

SHARED_END
#endif
