#version 460
#extension GL_GOOGLE_include_directive : require
// The finest level of the depth pyramid, from what the visibility holds: the ground, and the blades
// that have been drawn so far.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/raster/visibility.glsl"

layout(local_size_x = pyramidThreads, local_size_y = pyramidThreads) in;

void main()
{
    DepthPyramid pyramid = FRAME.pyramid;
    const uvec2 cell = gl_GlobalInvocationID.xy;
    const uvec2 cells = uvec2(pyramidCells(push.size.x, 0u), pyramidCells(push.size.y, 0u));
    if (any(greaterThanEqual(cell, cells)))
        return;
    Visibility visibility = Visibility(uvec2(push.visibility));
    const uvec2 low = cell << pyramidFactorBits;
    const uvec2 high = min(low + (1u << pyramidFactorBits), push.size);
    float farthest = 1.0;
    for (uint y = low.y; y < high.y; ++y) {
        const uint first = sampleIndex(uvec2(low.x, y), 0u);
        const uint end = first + (high.x - low.x) * samplesPerPixel;
        for (uint i = first; i < end; ++i)
            farthest = min(farthest, uintBitsToFloat(uint(visibility.at[i] >> 32u)));
    }
    DepthArray depths = pyramid.depths;
    depths.at[cell.y * cells.x + cell.x] = farthest;
}
