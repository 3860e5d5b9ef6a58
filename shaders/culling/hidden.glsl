// Whether the ground hides a box. FRAME is the frame.
#ifndef SWARD_HIDDEN_GLSL
#define SWARD_HIDDEN_GLSL

#include "shaders/shared/occlusion.h"

/// Whether all of a box lies behind what the pyramid has seen. Depths of the rasteriser and of the
/// box are rounded differently; the box is taken a hundred-thousandth nearer than it is.
bool isHidden(vec3 low, vec3 high)
{
    if (uvec2(FRAME.pyramid.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOf(FRAME.viewProjection, FRAME.pyramid.size, low, high);
    if (!box.isKnown)
        return false;
    const uint level = pyramidLevelFor(box, FRAME.pyramid.levels);
    const uint bits = pyramidFactorBits * (level + 1u);
    const uint row = pyramidCells(FRAME.pyramid.size.x, level);
    const uint first = FRAME.pyramid.first[level];
    const float nearest = box.nearest * 1.00001;
    for (int y = box.low.y >> bits; y <= box.high.y >> bits; ++y)
        for (int x = box.low.x >> bits; x <= box.high.x >> bits; ++x)
            if (FRAME.pyramid.depths.at[first + uint(y) * row + uint(x)] <= nearest)
                return false;
    return true;
}

#endif
