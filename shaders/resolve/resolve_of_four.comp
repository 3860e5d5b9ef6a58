#version 460
#extension GL_GOOGLE_include_directive : require
// Shades a visibility of four samples per pixel. Writes the pixels that are not soft to the picture; reconstruct.comp
// writes the tiles with soft pixels.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
// First the output of light_opaque.comp, then the whole pixel.
layout(set = 0, binding = 1, rgba16f) uniform image2D shaded;
layout(set = 2, binding = 1, STORED_FORMAT) uniform writeonly image2D picture;

#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"

#include "shaders/resolve/resolve.glsl"
#include "shaders/resolve/half_rounded.glsl"
#include "shaders/resolve/stored.glsl"

const uint gatherTile = rasterTile;
#include "shaders/resolve/gather.glsl"
#include "shaders/resolve/tile_classification.glsl"

shared uint softPixels;

void main()
{
    uvec2 tile;
    if (!findTile(tile))
        return;
    Visibility visibility = Visibility(uvec2(push.visibility));
    const Lens lens = lensOf();
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 pixel = pixelOf(tile, thread);
    const bool isInside = all(lessThan(pixel, push.size));
    if (thread == 0u) {
        gatheredCount = 0u;
        softPixels = 0u;
    }
    barrier();

    uint seen[samplesPerPixel];
    uint leaders = 0u;
    if (isInside) {
        for (uint s = 0u; s < samplesPerPixel; ++s)
            seen[s] = uint(visibility.at[sampleIndex(pixel, s)]);
        leaders = gatherTasks(thread, seen, push.firstBlade, ~0u);
    }
    barrier();

    for (uint i = thread; showsBlades && i < gatheredCount; i += gatherThreads) {
        const ShadingTask task = taskAt(i);
        const uvec2 place = pixelOf(tile, task.thread);
        const uint64_t word = visibility.at[sampleIndex(place, task.s)];
        putLight(task, shade(lens, seenBlade(uint(word) - push.firstBlade), vec2(place), task.samples,
                               task.s, uintBitsToFloat(uint(word >> 32u))));
    }
    barrier();

    if (!isInside)
        return;
    // Clear for the next frame.
    for (uint s = 0u; s < samplesPerPixel; ++s)
        visibility.at[sampleIndex(pixel, s)] = uint64_t(0u);
    vec4 sum = sumOfLight(thread, leaders);
    float sky = 0.0;
    bool seesOpaque = false;
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        sky += seen[s] == 0u ? 1.0 : 0.0;
        seesOpaque = seesOpaque || (seen[s] > 0u && seen[s] < push.firstBlade);
    }
    if (showsSky && sky > 0.0)
        sum += sky * skyAt(lens, pixel);
    vec4 mean = sum / float(samplesPerPixel);
    if (seesOpaque)
        mean += imageLoad(shaded, ivec2(pixel));
    const vec4 rounded = halfRounded(mean);
    imageStore(shaded, ivec2(pixel), rounded);
    if (rounded.a >= 1.0)
        imageStore(picture, ivec2(pixel), stored(rounded.rgb));
    else if (atomicAdd(softPixels, 1u) == 0u)
        putTile(tilesOfSoft, tile);
}
