// Tests whether the geometry drawn before hides a rectangle of the screen. FRAME is the frame that owns the pyramid.
#ifndef SWARD_RASTER_HIDDEN_RECTANGLE_GLSL
#define SWARD_RASTER_HIDDEN_RECTANGLE_GLSL

#define PYRAMID FRAME.pyramid
// The levels that seen_depths.comp fills. A span of a blade rarely needs more than four cells of the coarsest one; a
// larger span counts as visible.
#define PYRAMID_LEVELS min(PYRAMID.levels, pyramidFirstOfRest)
#define READS_CELLS_TOGETHER
#include "shaders/cull/behind_pyramid.glsl"
#include "shaders/shared/passes.h"

/// Whether everything between `low` and `high` [pixels] with reversed depth at most `nearest` is invisible. Points
/// outside the picture are invisible, too.
bool rectangleHidden(vec2 low, vec2 high, float nearest)
{
    const vec2 last = vec2(PYRAMID.size) - 1.0;
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, last + 1.0)))
        return true;
    ScreenBox box;
    // The values are not negative, so truncation rounds down.
    box.low = ivec2(clamp(low, vec2(0.0), last));
    box.high = ivec2(clamp(high, vec2(0.0), last));
    box.nearest = nearest;
    box.isKnown = true;
    return behindPyramid(box);
}

/// The same for pixels of a row, from column `low` to `high` of the picture. They lie in at most three cells of the
/// finest level; the rectangle around a whole segment would need larger cells.
bool pixelsHidden(uint row, uint low, uint high, float nearest)
{
    const uint cells = PYRAMID.first[0] + (row >> pyramidFactorBits) * pyramidCells(PYRAMID.size.x, 0u);
    const uvec3 own = min((low >> pyramidFactorBits) + uvec3(0u, 1u, 2u), uvec3(high >> pyramidFactorBits));
    const vec3 depths = vec3(PYRAMID.depths.at[cells + own.x], PYRAMID.depths.at[cells + own.y],
                             PYRAMID.depths.at[cells + own.z]);
    return all(greaterThan(depths, vec3(nearest * 1.00001)));
}

#endif
