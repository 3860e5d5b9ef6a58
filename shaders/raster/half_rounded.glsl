// Rounding to what a picture of 16 bits a channel holds.
#ifndef SWARD_RASTER_HALF_ROUNDED_GLSL
#define SWARD_RASTER_HALF_ROUNDED_GLSL

/// The nearest of the values that 16 bits hold, so that no device rounds them another way: some cut
/// off instead, which darkens one pixel in fifteen by a step. The picture's values are not negative.
vec4 halfRounded(vec4 value)
{
    const uint droppedBits = 13u;
    const uvec4 bits = floatBitsToUint(value) + (1u << (droppedBits - 1u));
    return uintBitsToFloat(bits & ~((1u << droppedBits) - 1u));
}

#endif
