// A point of a rib.
#ifndef SWARD_RIB_POINT_GLSL
#define SWARD_RIB_POINT_GLSL

#include "shaders/shared/ribbon.h"

/// From its left (0) to its right (1).
vec3 onRib(Rib rib, float u)
{
    return u < 0.5 ? mix(rib.left, rib.ridge, 2.0 * u) : mix(rib.ridge, rib.right, 2.0 * u - 1.0);
}

#endif
