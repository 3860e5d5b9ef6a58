// Encoding of pixels in the memory of a picture: sRGB in bytes, or radiance in 16-bit floating point. The including stage has a push constant `push` of type RasterPush.
#ifndef SWARD_RESOLVE_STORED_GLSL
#define SWARD_RESOLVE_STORED_GLSL

#include "shaders/common/output_mode.glsl"
#include "shaders/resolve/half_rounded.glsl"

/// sRGB-encodes a linear colour (IEC 61966-2-1).
vec3 encodeSrgb(vec3 c)
{
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec4 stored(vec3 color)
{
    if (outputMode == outputRadiance)
        return halfRounded(vec4(color, 1.0));
    const vec3 encoded = encodeSrgb(color);
    return vec4(push.isBgr != 0u ? encoded.bgr : encoded, 1.0);
}

#endif
