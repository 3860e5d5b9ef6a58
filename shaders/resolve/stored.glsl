// Encoding of pixels in the memory of a picture. The including stage has a push constant `push` of type RasterPush.
#ifndef SWARD_RESOLVE_STORED_GLSL
#define SWARD_RESOLVE_STORED_GLSL

/// sRGB-encodes a linear colour (IEC 61966-2-1).
vec3 encodeSrgb(vec3 c)
{
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec4 stored(vec3 color)
{
    const vec3 encoded = encodeSrgb(color);
    return vec4(push.isBgr != 0u ? encoded.bgr : encoded, 1.0);
}

#endif
