// The quadratic Bézier curve of a blade.
#ifndef SWARD_SHARED_BEZIER_H
#define SWARD_SHARED_BEZIER_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_FN vec3 bezierPoint(vec3 v0, vec3 v1, vec3 v2, float t)
{
    const vec3 a = v0 + t * (v1 - v0);
    const vec3 b = v1 + t * (v2 - v1);
    return a + t * (b - a);
}

/// First derivative; its length is the speed along the curve.
SHARED_FN vec3 bezierTangent(vec3 v0, vec3 v1, vec3 v2, float t)
{
    return 2.0f * ((1.0f - t) * (v1 - v0) + t * (v2 - v1));
}

SHARED_END
#endif
