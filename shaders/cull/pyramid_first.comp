#version 460
#extension GL_GOOGLE_include_directive : require
// The finest level of the depth pyramid, from a picture with one sample per pixel.
#include "shaders/shared/passes.h"

layout(set = 0, binding = 0) uniform sampler2D depths;

#include "shaders/cull/first_level.glsl"

float farthestAt(ivec2 pixel)
{
    return reversed(texelFetch(depths, pixel, 0).x);
}
