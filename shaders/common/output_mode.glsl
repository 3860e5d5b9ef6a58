// What becomes of light: see outputFilm and its neighbours.
#ifndef SWARD_COMMON_OUTPUT_MODE_GLSL
#define SWARD_COMMON_OUTPUT_MODE_GLSL

#include "shaders/shared/constants.h"

/// Target of the light; known at pipeline creation.
layout(constant_id = idOutputMode) const uint outputMode = outputFilm;

#endif
