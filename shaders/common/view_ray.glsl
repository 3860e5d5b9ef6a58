// Rays of a view. The including stage has the frame as FRAME, or in its push constant `push`.
#ifndef SWARD_COMMON_VIEW_RAY_GLSL
#define SWARD_COMMON_VIEW_RAY_GLSL

#include "shaders/shared/frame.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

/// The ray through a place of the picture in clip coordinates, (x, y, ·, 1); its length gives clip w = 1.
vec3 rayThrough(vec2 place)
{
    return place.x * FRAME.rays[0] + (place.y * FRAME.rays[1] + FRAME.rays[2]);
}

#endif
