#version 460
#extension GL_GOOGLE_include_directive : require
// Of pictures with four samples a pixel: runs once for each of them.
uint sampleOfPixel()
{
    return uint(gl_SampleID);
}

#define AT_SAMPLE sample
#include "shaders/raster/large_blade.glsl"
