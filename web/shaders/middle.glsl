// Where a pixel's samples are drawn one by one, each surface is lit once a pixel all the same: in the pixel's middle,
// as the viewer's resolve does it.
#ifndef SWARD_WEB_MIDDLE_GLSL
#define SWARD_WEB_MIDDLE_GLSL

uniform vec2 sampleOffset; // [pixels] of the sample that is drawn from the middle of its pixel, y downwards

vec2 inMiddle(vec2 value)
{
    return value - sampleOffset.x * dFdx(value) + sampleOffset.y * dFdy(value);
}

vec3 inMiddle(vec3 value)
{
    return value - sampleOffset.x * dFdx(value) + sampleOffset.y * dFdy(value);
}

#endif
