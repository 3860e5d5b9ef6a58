#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels, of one field.
#include "shaders/raster/raster_large.glsl"
