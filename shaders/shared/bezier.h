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

/// Length of the curve from the origin over v1 to v2, by Gauss–Legendre quadrature of the speed in
/// four points. For blades as poseBlade() shapes them the relative error is below 1e-3 (the paper's
/// estimate after Gravesen, (2·|v2−v0| + |v1−v0| + |v2−v1|)/3, reaches 1.1e-2): asserted by
/// bezier_test.cpp.
SHARED_FN float bezierLength(vec3 v1, vec3 v2)
{
    const vec3 origin = vec3(0.0f);
    return 0.17392742f * (length(bezierTangent(origin, v1, v2, 0.06943184f)) +
                          length(bezierTangent(origin, v1, v2, 0.93056816f))) +
           0.32607258f * (length(bezierTangent(origin, v1, v2, 0.33000948f)) +
                          length(bezierTangent(origin, v1, v2, 0.66999052f)));
}

SHARED_END
#endif
