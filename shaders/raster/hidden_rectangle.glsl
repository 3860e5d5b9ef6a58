// Whether what has been drawn so far hides a rectangle of the screen. FRAME is the frame whose pyramid
// is asked.
#ifndef SWARD_RASTER_HIDDEN_RECTANGLE_GLSL
#define SWARD_RASTER_HIDDEN_RECTANGLE_GLSL

#define PYRAMID FRAME.pyramid
// Those that seen_depths.comp fills: of four cells of the coarsest of them a span of a blade hardly needs
// more, and one that does counts as seen.
#define PYRAMID_LEVELS min(PYRAMID.levels, pyramidFirstOfRest)
#define READS_CELLS_TOGETHER
#include "shaders/culling/behind_pyramid.glsl"
#include "shaders/shared/passes.h"

/// Whether nothing between `low` and `high` [pixels] can be seen whose reversed depth is `nearest` at
/// most. What lies beside the picture is not seen, either.
bool rectangleHidden(vec2 low, vec2 high, float nearest)
{
    const vec2 last = vec2(PYRAMID.size) - 1.0;
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, last + 1.0)))
        return true;
    ScreenBox box;
    // Nothing that is negative is left to be rounded.
    box.low = ivec2(clamp(low, vec2(0.0), last));
    box.high = ivec2(clamp(high, vec2(0.0), last));
    box.nearest = nearest;
    box.isKnown = true;
    return behindPyramid(box);
}

/// The same of some pixels of a row, from column `low` to `high` of the picture, so few that they lie in
/// three cells of the finest level: where the rectangle around a whole segment asked larger ones.
bool pixelsHidden(uint row, uint low, uint high, float nearest)
{
    const uint cells = PYRAMID.first[0] + (row >> pyramidFactorBits) * pyramidCells(PYRAMID.size.x, 0u);
    const uvec3 own = min((low >> pyramidFactorBits) + uvec3(0u, 1u, 2u), uvec3(high >> pyramidFactorBits));
    const vec3 depths = vec3(PYRAMID.depths.at[cells + own.x], PYRAMID.depths.at[cells + own.y],
                             PYRAMID.depths.at[cells + own.z]);
    return all(greaterThan(depths, vec3(nearest * 1.00001)));
}

#endif
