#version 460
#extension GL_GOOGLE_include_directive : require
// The finest levels of the depth pyramid, from what the visibility holds: the ground, and the blades
// that have been drawn so far.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/culling/finest_levels.glsl"
#include "shaders/raster/put_sample.glsl"

void main()
{
    // Threads beside one another read what lies below one another, which is together in memory.
    const uvec2 own = gl_LocalInvocationID.yx;
    const uvec2 low = (gl_WorkGroupID.xy * pyramidThreads + own) << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), push.size);
    uint farthest = floatBitsToUint(1.0);
    for (uint x = low.x; x < high.x && low.y < high.y; ++x) {
        const uint first = sampleIndex(uvec2(x, low.y), 0u);
        SHARED_UNROLL for (uint i = 0u; i < samplesPerPixel << pyramidFactorBits; i += 2u) {
            const uvec2 two = depthsAt(first + i);
            if (low.y + i / samplesPerPixel < high.y)
                farthest = min(farthest, two.x);
            if (low.y + (i + 1u) / samplesPerPixel < high.y)
                farthest = min(farthest, two.y);
        }
    }
    putFinestLevels(FRAME.pyramid, own, uintBitsToFloat(farthest));
}
