#version 460
#extension GL_GOOGLE_include_directive : require
// The finest levels of the depth pyramid, from what the visibility holds: the ground, and the blades
// that have been drawn so far.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/culling/finest_levels.glsl"
#include "shaders/raster/visibility.glsl"

void main()
{
    DepthPyramid pyramid = FRAME.pyramid;
    Visibility visibility = Visibility(uvec2(push.visibility));
    const uvec2 low = gl_GlobalInvocationID.xy << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), push.size);
    float farthest = 1.0;
    for (uint x = low.x; low.y < high.y && x < high.x; ++x) {
        const uint first = sampleIndex(uvec2(x, low.y), 0u);
        const uint end = first + (high.y - low.y) * samplesPerPixel;
        for (uint i = first; i < end; ++i)
            farthest = min(farthest, uintBitsToFloat(uint(visibility.at[i] >> 32u)));
    }
    putFinestLevels(pyramid, farthest);
}
