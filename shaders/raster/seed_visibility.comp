#version 460
#extension GL_GOOGLE_include_directive : require
// Initialises a visibility with a host's depths: value 0 at the depth of the host's geometry. The depth picture has the
// visibility's number of samples.
#define HAS_INSTANCES // it reads no frame
#include "shaders/raster/instances.glsl"
#include "shaders/raster/visibility.glsl"
#include "shaders/shared/constants.h"

layout(local_size_x = seedThreads, local_size_y = seedThreads) in;

/// Whether depths are 0 near and 1 far; known at pipeline creation.
layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;

#ifdef SEVERAL_SAMPLES
layout(set = 0, binding = 0) uniform sampler2DMS depths;
#else
layout(set = 0, binding = 0) uniform sampler2D depths;
#endif

/// The depth of a sample. A picture of one sample has a level in its place.
float depthOfHost(ivec2 pixel, uint s)
{
    return texelFetch(depths, pixel, int(s)).x;
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, host.size)))
        return;
    push.size = host.size;
    Visibility visibility = Visibility(uvec2(host.visibility));
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        const float depth = depthOfHost(ivec2(pixel), s);
        const float reversed = max((hasForwardZ ? 1.0 - depth : depth) - host.slack, 0.0);
        visibility.at[sampleIndex(pixel, s)] = uint64_t(floatBitsToUint(reversed)) << 32u;
    }
}
