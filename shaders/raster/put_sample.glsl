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

/// A VisibilityArray as words of 32 bits: of each sample what is seen, and then its depth.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer VisibilityHalves
{
    uint at[];
};

/// The same, two samples at a time.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer VisibilityPairs
{
    uvec4 at[];
};

/// Four samples of a row that lie so far apart: one of each of four pixels, or all of one.
struct FourSamples {
    uint first; ///< sampleIndex()
    uint stride;
    uint covered; ///< as bits
    float depths[4];
};

/// The depths, as bits, that four samples have already: of a pixel the whole of it, …
uvec4 depthsOfPixel(uint first)
{
    VisibilityPairs pairs = VisibilityPairs(uvec2(push.visibility));
    const uvec4 low = pairs.at[first / 2u];
    const uvec4 high = pairs.at[first / 2u + 1u];
    return uvec4(low.y, low.w, high.y, high.w);
}

/// … or of samples that lie apart. What lies right of the picture may be read.
uvec4 depthsApart(uint first, uint stride)
{
    VisibilityHalves halves = VisibilityHalves(uvec2(push.visibility));
    uvec4 depths;
    SHARED_UNROLL for (uint s = 0u; s < 4u; ++s)
        depths[s] = halves.at[2u * (first + s * stride) + 1u];
    return depths;
}

void putFour(uvec4 earlier, FourSamples four, uint blade)
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    SHARED_UNROLL for (uint s = 0u; s < 4u; ++s) {
        // Of equal depths the atomic takes the larger id.
        const uint bits = floatBitsToUint(four.depths[s]);
        if ((four.covered & (1u << s)) != 0u && bits >= earlier[s])
            atomicMax(visibility.at[four.first + s * four.stride],
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
