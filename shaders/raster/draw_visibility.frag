#version 460
#extension GL_GOOGLE_include_directive : require
// Draws a visibility.
#include "shaders/raster/draw_visibility.glsl"
