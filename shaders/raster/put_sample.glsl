// One sample of one blade.
#ifndef SWARD_RASTER_PUT_SAMPLE_GLSL
#define SWARD_RASTER_PUT_SAMPLE_GLSL

#include "shaders/raster/visibility.glsl"
#include "shaders/shared/ribbon.h"

void putSample(uvec2 pixel, uint s, float depth, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    const uint index = sampleIndex(pixel, s);
    const uint64_t value = (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(push.firstBlade + blade);
    // Rejects most hidden samples without an atomic.
    if (visibility.at[index] < value)
        atomicMax(visibility.at[index], value);
}

/// A VisibilityArray as words of 32 bits: for each sample its value, then its depth.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer VisibilityHalves
{
    uint at[];
};

/// The same in units of two samples.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer VisibilityPairs
{
    uvec4 at[];
};

/// The stored depth of a sample, as bits, …
uint depthAt(uint index)
{
    VisibilityHalves halves = VisibilityHalves(uvec2(push.visibility));
    return halves.at[2u * index + 1u];
}

/// … or of two samples; `index` is even.
uvec2 depthsAt(uint index)
{
    VisibilityPairs pairs = VisibilityPairs(uvec2(push.visibility));
    return pairs.at[index / 2u].yw;
}

/// Writes a sample of a small blade, without a test before: an atomic with an unused result causes no wait, and a test
/// would take longer.
void putOne(uint index, float depth, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    atomicMax(visibility.at[index],
              (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(push.firstBlade + blade));
}

/// Writes the samples of a pixel whose bit in `covered` is set.
void putSmall(uvec2 pixel, uint covered, float depths[samplesPerPixel], uint blade)
{
    const uint first = sampleIndex(pixel, 0u);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((covered & (1u << s)) != 0u)
            putOne(first + s, depths[s], blade);
}

#endif
