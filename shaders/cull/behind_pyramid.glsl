// Tests whether a screen box lies completely behind the depths of a depth pyramid. PYRAMID is the pyramid, in memory;
// PYRAMID_LEVELS is the number of its filled levels.
#ifndef SWARD_CULL_BEHIND_PYRAMID_GLSL
#define SWARD_CULL_BEHIND_PYRAMID_GLSL

#include "shaders/shared/occlusion.h"

#ifndef PYRAMID_LEVELS
#define PYRAMID_LEVELS PYRAMID.levels
#endif

/// The rasteriser and the test round depths differently, so the box is taken a hundred-thousandth nearer than it is.
bool behindPyramid(ScreenBox box)
{
    const uint level = pyramidLevelFor(box, PYRAMID_LEVELS);
    const uint bits = pyramidFactorBits * (level + 1u);
    // The box is too large for the coarsest level.
    if (any(greaterThanEqual((box.high >> bits) - (box.low >> bits), ivec2(pyramidReach))))
        return false;
    const uint row = pyramidCells(PYRAMID.size.x, level);
    const uint first = PYRAMID.first[level];
    const float nearest = box.nearest * 1.00001;
    const ivec2 low = box.low >> bits;
    const ivec2 high = box.high >> bits;
#ifdef READS_CELLS_TOGETHER
    // Reads the cells of two columns with one wait. In a shader with high register pressure this costs more than it
    // gains.
    for (int x = low.x; x <= high.x; x += 2) {
        float farthest = 1.0;
        SHARED_UNROLL for (int y = 0; y < pyramidReach; ++y) {
            const uint cells = first + uint(min(low.y + y, high.y)) * row;
            farthest = min(farthest, min(PYRAMID.depths.at[cells + uint(x)],
                                         PYRAMID.depths.at[cells + uint(min(x + 1, high.x))]));
        }
        if (farthest <= nearest)
            return false;
    }
#else
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (PYRAMID.depths.at[first + uint(y) * row + uint(x)] <= nearest)
                return false;
#endif
    return true;
}

#endif
