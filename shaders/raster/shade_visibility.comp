#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility that shows one instance.
#define ONE_INSTANCE
#include "shaders/raster/shade_visibility.glsl"
