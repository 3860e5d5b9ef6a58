// The finest levels of the depth pyramid. The including shader declares `depths`, and defines farthestAt(), the
// reversed depth of the farthest of a pixel's samples.
#include "shaders/cull/finest_levels.glsl"
#include "shaders/shared/constants.h"

layout(push_constant, scalar) uniform Block { PyramidPush push; };

/// Whether depths are 0 near and 1 far; known at pipeline creation.
layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;

/// The depth with 1 near and 0 far.
float reversed(float depth)
{
    return hasForwardZ ? 1.0 - depth : depth;
}

float farthestAt(ivec2 pixel);

void main()
{
    DepthPyramid pyramid = push.frame.at[0].pyramid;
    const uvec2 low = gl_GlobalInvocationID.xy << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), pyramid.size);
    float farthest = 1.0;
    for (uint y = low.y; y < high.y; ++y)
        for (uint x = low.x; x < high.x; ++x)
            farthest = min(farthest, farthestAt(ivec2(x, y)));
    if (all(lessThan(low, high)))
        farthest -= push.slack;
    putFinestLevels(pyramid, gl_LocalInvocationID.xy, farthest);
}
