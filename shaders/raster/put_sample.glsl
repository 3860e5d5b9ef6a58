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
    const uint64_t value = (uint64_t(floatBitsToUint(depth)) << 32u) | uint64_t(blade + 1u);
    // Most of what lies behind is turned away without an atomic.
    if (visibility.at[index] < value)
        atomicMax(visibility.at[index], value);
}

#endif
