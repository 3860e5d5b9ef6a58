// Whether the ground hides a box. JUDGED is the frame whose camera asks.
#ifndef SWARD_HIDDEN_GLSL
#define SWARD_HIDDEN_GLSL

#include "shaders/shared/occlusion.h"

/// Whether all of a box lies behind what the pyramid has seen. Depths of the rasteriser and of the
/// box are rounded differently; the box is taken a hundred-thousandth nearer than it is.
bool isHidden(vec3 low, vec3 high)
{
    if (uvec2(JUDGED.pyramid.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOf(JUDGED.viewProjection, JUDGED.pyramid.size, low, high);
    if (!box.isKnown)
        return false;
    const uint level = pyramidLevelFor(box, JUDGED.pyramid.levels);
    const uint bits = pyramidFactorBits * (level + 1u);
    const uint row = pyramidCells(JUDGED.pyramid.size.x, level);
    const uint first = JUDGED.pyramid.first[level];
    const float nearest = box.nearest * 1.00001;
    for (int y = box.low.y >> bits; y <= box.high.y >> bits; ++y)
        for (int x = box.low.x >> bits; x <= box.high.x >> bits; ++x)
            if (JUDGED.pyramid.depths.at[first + uint(y) * row + uint(x)] <= nearest)
                return false;
    return true;
}

#endif
