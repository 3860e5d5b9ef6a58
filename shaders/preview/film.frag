#version 460
#extension GL_GOOGLE_include_directive : require
// The picture from the resolved samples of the tessellator.

layout(set = 0, binding = 0) uniform sampler2D resolved[1];

layout(location = 0) out vec4 outColor;

vec4 pixelAt(ivec2 pixel)
{
    return texelFetch(resolved[0], clamp(pixel, ivec2(0), textureSize(resolved[0], 0) - 1), 0);
}

#include "shaders/resolve/reconstruction_filter.glsl"

void main()
{
    outColor = vec4(reconstructed(ivec2(gl_FragCoord.xy)), 1.0);
}
