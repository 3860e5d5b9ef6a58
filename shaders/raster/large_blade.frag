#version 460
#extension GL_GOOGLE_include_directive : require
// Of pictures with one sample a pixel.
uint sampleOfPixel()
{
    return 0u;
}

#define AT_SAMPLE
#include "shaders/raster/large_blade.glsl"
