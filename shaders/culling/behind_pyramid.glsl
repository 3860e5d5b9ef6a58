// Whether all of a part of the screen lies behind what a depth pyramid has seen. PYRAMID is the
// pyramid, in memory.
#ifndef SWARD_BEHIND_PYRAMID_GLSL
#define SWARD_BEHIND_PYRAMID_GLSL

#include "shaders/shared/occlusion.h"

/// Depths of the rasteriser and of what asks are rounded differently; what asks is taken a
/// hundred-thousandth nearer than it is.
bool behindPyramid(ScreenBox box)
{
    const uint level = pyramidLevelFor(box, PYRAMID.levels);
    const uint bits = pyramidFactorBits * (level + 1u);
    const uint row = pyramidCells(PYRAMID.size.x, level);
    const uint first = PYRAMID.first[level];
    const float nearest = box.nearest * 1.00001;
    for (int y = box.low.y >> bits; y <= box.high.y >> bits; ++y)
        for (int x = box.low.x >> bits; x <= box.high.x >> bits; ++x)
            if (PYRAMID.depths.at[first + uint(y) * row + uint(x)] <= nearest)
                return false;
    return true;
}

#endif
