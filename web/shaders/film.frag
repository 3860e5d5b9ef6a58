// The picture from the resolved samples, filtered where grass is finer than pixels, and encoded as sRGB.
// Linear light, and 1 − softness: of the picture, or of each of its samples.
uniform sampler2D resolved;
uniform sampler2D resolved1;
uniform sampler2D resolved2;
uniform sampler2D resolved3;
uniform bool hasSamples;

layout(location = 0) out vec4 outColor;

vec4 pixelAt(ivec2 pixel)
{
    pixel = clamp(pixel, ivec2(0), textureSize(resolved, 0) - 1);
    const vec4 first = texelFetch(resolved, pixel, 0);
    if (!hasSamples)
        return first;
    return 0.25 * (first + texelFetch(resolved1, pixel, 0) + texelFetch(resolved2, pixel, 0) +
                   texelFetch(resolved3, pixel, 0));
}

#include "shaders/resolve/reconstruction_filter.glsl"

void main()
{
    vec3 color = clamp(reconstructed(ivec2(gl_FragCoord.xy)), 0.0, 1.0);
    color = mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));
    outColor = vec4(color, 1.0);
}
