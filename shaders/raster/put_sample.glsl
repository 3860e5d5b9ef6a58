// One sample of one blade.
#ifndef SWARD_RASTER_PUT_SAMPLE_GLSL
#define SWARD_RASTER_PUT_SAMPLE_GLSL

#include "shaders/raster/visibility.glsl"
#include "shaders/shared/ribbon.h"

/// Whether sample `s` is among those that a place keeps where the blade is `weight.x` wide and drawn
/// `weight.y` wide.
bool keepsSample(vec2 weight, uint blade, uint s)
{
    const uint bits = keptSamples(weight.x / max(weight.y, 1e-12), blade, samplesPerPixel);
    return (bits & (1u << s)) != 0u;
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
