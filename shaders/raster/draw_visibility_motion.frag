#version 460
#extension GL_GOOGLE_include_directive : require
// Draws a visibility, and how the blades have moved.
#define HAS_MOTION
#include "shaders/raster/draw_visibility.glsl"
