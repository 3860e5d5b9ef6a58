// One sample of one blade, in a visibility of the order of shaders/raster/visibility.glsl: two words a sample, its value
// and the bits of its depth. With atomics of 64 bits a sample is written at once; else depths in a first pass, and in a
// second one the values of those that have kept their place. Both passes run the same program, so depths are equal to
// the bit.
#ifndef SWARD_WEB_WEBGPU_PUT_SAMPLE_GLSL
#define SWARD_WEB_WEBGPU_PUT_SAMPLE_GLSL

#include "shaders/raster/visibility.glsl"
#include "shaders/shared/ribbon.h"

#ifdef HAS_ATOMIC64

layout(binding = 9) buffer Seen { uvec2 seenSamples[]; };

void putOne(uint index, float depth, uint blade)
{
    atomicStoreMax(seenSamples[index], uvec2(push.firstBlade + blade, floatBitsToUint(depth)));
}

uint depthAt(uint index)
{
    return 0u;
}

#else

layout(binding = 9) buffer Seen { uint seenSamples[]; };

void putOne(uint index, float depth, uint blade)
{
    const uint bits = floatBitsToUint(depth);
    if (push.isIdPass == 0u)
        atomicMax(seenSamples[2u * index + 1u], bits);
    else if (seenSamples[2u * index + 1u] == bits)
        atomicMax(seenSamples[2u * index], push.firstBlade + blade);
}

uint depthAt(uint index)
{
    return seenSamples[2u * index + 1u];
}

#endif

uvec2 depthsAt(uint index)
{
    return uvec2(depthAt(index), depthAt(index + 1u));
}

/// Writes the samples of a pixel whose bit in `covered` is set.
void putSmall(uvec2 pixel, uint covered, float depths[samplesPerPixel], uint blade)
{
    const uint first = sampleIndex(pixel, 0u);
    for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((covered & (1u << s)) != 0u)
            putOne(first + s, depths[s], blade);
}

#endif
