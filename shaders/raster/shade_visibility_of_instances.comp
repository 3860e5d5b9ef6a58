#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility that shows several instances.
#include "shaders/raster/shade_visibility.glsl"
