#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that may reach through the near plane, of one field.
#include "shaders/raster/raster_cut.glsl"
