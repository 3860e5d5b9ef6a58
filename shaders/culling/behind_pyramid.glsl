// Whether all of a part of the screen lies behind what a depth pyramid has seen. PYRAMID is the
// pyramid, in memory, and PYRAMID_LEVELS how many of its levels have been filled.
#ifndef SWARD_BEHIND_PYRAMID_GLSL
#define SWARD_BEHIND_PYRAMID_GLSL

#include "shaders/shared/occlusion.h"

#ifndef PYRAMID_LEVELS
#define PYRAMID_LEVELS PYRAMID.levels
#endif

/// Whether one of the cells from column `low` to `high` of a row, pyramidReach at most, whose first
/// cell is `row`, is no nearer than `nearest`.
#ifdef READS_CELLS_TOGETHER
// They are waited for once; in a shader that has much to remember that costs more than it gains.
bool seesBehind(uint row, int low, int high, float nearest)
{
    const uvec4 cells = row + uvec4(min(low + ivec4(0, 1, 2, 3), ivec4(high)));
    const vec4 depths = vec4(PYRAMID.depths.at[cells.x], PYRAMID.depths.at[cells.y],
                             PYRAMID.depths.at[cells.z], PYRAMID.depths.at[cells.w]);
    return any(lessThanEqual(depths, vec4(nearest)));
}
#else
bool seesBehind(uint row, int low, int high, float nearest)
{
    for (int x = low; x <= high; ++x)
        if (PYRAMID.depths.at[row + uint(x)] <= nearest)
            return true;
    return false;
}
#endif

/// Depths of the rasteriser and of what asks are rounded differently; what asks is taken a
/// hundred-thousandth nearer than it is.
bool behindPyramid(ScreenBox box)
{
    const uint level = pyramidLevelFor(box, PYRAMID_LEVELS);
    const uint bits = pyramidFactorBits * (level + 1u);
    // Too large for the coarsest level.
    if (any(greaterThanEqual((box.high >> bits) - (box.low >> bits), ivec2(pyramidReach))))
        return false;
    const uint row = pyramidCells(PYRAMID.size.x, level);
    const uint first = PYRAMID.first[level];
    const float nearest = box.nearest * 1.00001;
    for (int y = box.low.y >> bits; y <= box.high.y >> bits; ++y)
        if (seesBehind(first + uint(y) * row, box.low.x >> bits, box.high.x >> bits, nearest))
            return false;
    return true;
}

#endif
