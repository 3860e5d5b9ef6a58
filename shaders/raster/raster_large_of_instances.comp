#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels, of all instances of a host's view.
#define HAS_INSTANCES
#include "shaders/raster/raster_large.glsl"
