// Begins a visibility with the depths of the ground, and makes their pyramid: of each cell the farthest one. A work-group has
// a cell of the second level.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/raster/visibility.glsl"
#include "web/shaders/webgpu/seen_samples.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 19) buffer Cells { uint cellBits[]; };
layout(binding = 20) uniform textureDepth2DMS groundDepth;

const uint nearestBits = 0x3f800000u; // of depth 1

// Depths are not negative: their bits have the same order.
shared uint ofFirst[16];
shared uint ofSecond;

void putCell(uint level, uvec2 cell, uint bits)
{
    if (level < push.pyramid.levels)
        atomicMin(cellBits[push.pyramid.first[level] + cell.y * pyramidCells(push.pyramid.size.x, level) + cell.x], bits);
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    const uint thread = gl_LocalInvocationIndex;
    if (thread < 16u)
        ofFirst[thread] = nearestBits;
    if (thread == 0u)
        ofSecond = nearestBits;
    barrier();
    if (all(lessThan(pixel, push.size))) {
        const uint first = sampleIndex(pixel, 0u);
        uint farthest = nearestBits;
        for (uint s = 0u; s < samplesPerPixel; ++s) {
            const uint bits = floatBitsToUint(texelFetch(groundDepth, ivec2(pixel), int(s)));
            seenSamples[first + s] = uvec2(0u, bits);
            farthest = min(farthest, bits);
        }
        const uvec2 cell = gl_LocalInvocationID.xy / 4u;
        atomicMin(ofFirst[cell.y * 4u + cell.x], farthest);
    }
    barrier();
    if (thread < 16u) {
        const uvec2 cell = gl_WorkGroupID.xy * 4u + uvec2(thread % 4u, thread / 4u);
        if (all(lessThan(cell, uvec2(pyramidCells(push.size.x, 0u), pyramidCells(push.size.y, 0u)))))
            putCell(0u, cell, ofFirst[thread]);
        atomicMin(ofSecond, ofFirst[thread]);
    }
    barrier();
    if (thread > 0u)
        return;
    const uint bits = ofSecond;
    for (uint level = 1u; level < push.pyramid.levels; ++level)
        putCell(level, gl_WorkGroupID.xy >> (pyramidFactorBits * (level - 1u)), bits);
}
