// The picture, filtered where grass is finer than pixels, and encoded as sRGB.
layout(binding = 0) uniform texture2D resolvedPicture;

layout(location = 0) out vec4 outColor;

vec4 pixelAt(ivec2 pixel)
{
    return texelFetch(resolvedPicture, clamp(pixel, ivec2(0), textureSize(resolvedPicture, 0) - 1), 0);
}

#include "shaders/resolve/reconstruction_filter.glsl"

void main()
{
    vec3 color = clamp(reconstructed(ivec2(gl_FragCoord.xy)), 0.0, 1.0);
    color = mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));
    outColor = vec4(color, 1.0);
}
