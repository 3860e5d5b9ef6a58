// A point of a cross-section.
#ifndef SWARD_BLADE_CROSS_SECTION_POINT_GLSL
#define SWARD_BLADE_CROSS_SECTION_POINT_GLSL

#include "shaders/shared/ribbon.h"

/// `u` runs from the left end (0) to the right end (1).
vec3 onCrossSection(CrossSection section, float u)
{
    return u < 0.5 ? mix(section.left, section.ridge, 2.0 * u) : mix(section.ridge, section.right, 2.0 * u - 1.0);
}

#endif
