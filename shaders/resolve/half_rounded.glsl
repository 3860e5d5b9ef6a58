// Rounding to the values of a 16-bit-per-channel picture.
#ifndef SWARD_RESOLVE_HALF_ROUNDED_GLSL
#define SWARD_RESOLVE_HALF_ROUNDED_GLSL

/// The nearest 16-bit value, so that all devices round equally: some truncate, which darkens one pixel in fifteen by a
/// step. The picture's values are not negative.
vec4 halfRounded(vec4 value)
{
    const uint droppedBits = 13u;
    const uvec4 bits = floatBitsToUint(value) + (1u << (droppedBits - 1u));
    return uintBitsToFloat(bits & ~((1u << droppedBits) - 1u));
}

#endif
