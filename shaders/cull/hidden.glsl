// Tests whether the ground hides something. CULL_VIEW is the frame of the tested camera.
#ifndef SWARD_CULL_HIDDEN_GLSL
#define SWARD_CULL_HIDDEN_GLSL

#define PYRAMID CULL_VIEW.pyramid
#include "shaders/cull/behind_pyramid.glsl"

/// Whether a box lies completely behind the depths of the pyramid.
bool isHidden(vec3 low, vec3 high)
{
    if (uvec2(PYRAMID.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOf(CULL_VIEW.viewProjection, PYRAMID.size, low, high);
    return box.isKnown && behindPyramid(box);
}

/// The same for all points within `margin` [m] of a curve.
bool isHidden(vec3 v0, vec3 v1, vec3 v2, float margin)
{
    if (uvec2(PYRAMID.depths) == uvec2(0u))
        return false;
    const ScreenBox box = screenBoxOfCurve(CULL_VIEW.viewProjection, PYRAMID.size, v0, v1, v2, margin);
    return box.isKnown && behindPyramid(box);
}

#endif
