// What stands in the memory of a picture. The including stage has a push constant `push` of type
// RasterPush.
#ifndef SWARD_RASTER_STORED_GLSL
#define SWARD_RASTER_STORED_GLSL

/// sRGB-encodes a linear colour (IEC 61966-2-1).
vec3 encodeSrgb(vec3 c)
{
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

/// The nearest of the values that 16 bits hold, so that no device rounds them another way: some cut
/// off instead, which darkens one pixel in fifteen by a step. The picture's values are not negative.
vec4 halfRounded(vec4 value)
{
    const uint droppedBits = 13u;
    const uvec4 bits = floatBitsToUint(value) + (1u << (droppedBits - 1u));
    return uintBitsToFloat(bits & ~((1u << droppedBits) - 1u));
}

vec4 stored(vec3 color)
{
    const vec3 encoded = encodeSrgb(color);
    return vec4(push.isBgr != 0u ? encoded.bgr : encoded, 1.0);
}

#endif
