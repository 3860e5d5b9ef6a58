// Whether the ground hides something. CULL_VIEW is the frame whose camera asks.
#ifndef SWARD_HIDDEN_GLSL
#define SWARD_HIDDEN_GLSL

#define PYRAMID CULL_VIEW.pyramid
#include "shaders/culling/behind_pyramid.glsl"

/// Whether all of a box lies behind what the pyramid has seen.
bool isHidden(vec3 low, vec3 high)
{
    if (uvec2(PYRAMID.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOf(CULL_VIEW.viewProjection, PYRAMID.size, low, high);
    return box.isKnown && behindPyramid(box);
}

/// Whether all that is no farther than `margin` [m] from a curve does.
bool isHidden(vec3 v0, vec3 v1, vec3 v2, float margin)
{
    if (uvec2(PYRAMID.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOfCurve(CULL_VIEW.viewProjection, PYRAMID.size, v0, v1, v2, margin);
    return box.isKnown && behindPyramid(box);
}

#endif
