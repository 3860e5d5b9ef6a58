// Colours as a host's framebuffer has them.
#ifndef SWARD_WEB_HOST_GLSL
#define SWARD_WEB_HOST_GLSL

uniform bool isLinear; // the framebuffer keeps linear light; else sRGB

vec3 forHost(vec3 color)
{
    color = clamp(color, 0.0, 1.0);
    if (isLinear)
        return color;
    return mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));
}

#endif
