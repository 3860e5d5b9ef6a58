// One sample of one blade.
#ifndef SWARD_RASTER_PUT_SAMPLE_GLSL
#define SWARD_RASTER_PUT_SAMPLE_GLSL

#include "shaders/raster/visibility.glsl"
#include "shaders/shared/ribbon.h"

/// The samples that a place keeps, as bits, where the blade is `weight.x` wide and drawn `weight.y`
/// wide.
uint samplesKept(vec2 weight, uint blade)
{
    return keptSamples(weight.x / max(weight.y, 1e-12), blade, samplesPerPixel);
}

void putSample(uvec2 pixel, uint s, float depth, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    const uint index = sampleIndex(pixel, s);
    const uint64_t value = (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(push.firstBlade + blade);
    // Most of what lies behind is turned away without an atomic.
    if (visibility.at[index] < value)
        atomicMax(visibility.at[index], value);
}

/// Samples read two at a time: most are nearer than what comes.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer VisibilityPairs
{
    uvec4 at[];
};

/// Four samples of one row that lie next to each other: of one pixel, or of four.
struct FourSamples {
    uint index;   ///< of the first, a multiple of 4
    uint covered; ///< as bits
    float depths[4];
};

/// The depths, as bits, that four samples from `index` on have already, a multiple of 4. What lies
/// behind the picture's last sample may be read.
uvec4 depthsBefore(uint index)
{
    VisibilityPairs pairs = VisibilityPairs(uvec2(push.visibility));
    const uvec4 low = pairs.at[index / 2u];
    const uvec4 high = pairs.at[index / 2u + 1u];
    return uvec4(low.y, low.w, high.y, high.w);
}

void putFour(uvec4 earlier, FourSamples four, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    SHARED_UNROLL for (uint s = 0u; s < 4u; ++s) {
        // Of equal depths the atomic takes the larger id.
        const uint bits = floatBitsToUint(four.depths[s]);
        if ((four.covered & (1u << s)) != 0u && bits >= earlier[s])
            atomicMax(visibility.at[four.index + s],
                      (uint64_t(bits) << 32u) | uint64_t(push.firstBlade + blade));
    }
}

/// A sample of a blade that has few: nobody waits for an atomic's result, and to ask first whether it
/// is needed takes longer.
void putOne(uint index, float depth, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    atomicMax(visibility.at[index],
              (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(push.firstBlade + blade));
}

/// Those of a pixel that are `covered`, as bits.
void putSmall(uvec2 pixel, uint covered, float depths[samplesPerPixel], uint blade)
{
    const uint first = sampleIndex(pixel, 0u);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((covered & (1u << s)) != 0u)
            putOne(first + s, depths[s], blade);
}

#endif
