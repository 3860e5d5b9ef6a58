#version 460
#extension GL_GOOGLE_include_directive : require
// Makes the picture of a visibility of one sample per pixel.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2D opaque; // the output of light_opaque.comp
layout(set = 0, binding = 1, STORED_FORMAT) uniform writeonly image2D picture;

#include "shaders/resolve/stored.glsl"
#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"
#include "shaders/resolve/resolve.glsl"
#include "shaders/resolve/tile_classification.glsl"

/// `word`: the pixel's value in the visibility.
vec4 shadeAt(uvec2 pixel, uint64_t word)
{
    const Lens lens = lensOf();
    const uint what = uint(word);
    if (showsBlades && what >= push.firstBlade)
        return shade(lens, seenBlade(what - push.firstBlade), vec2(pixel), 1u, 0u,
                     uintBitsToFloat(uint(word >> 32u)));
    return !showsSky || what > 0u ? texelFetch(opaque, ivec2(pixel), 0) : skyAt(lens, pixel);
}

void main()
{
    uvec2 tile;
    if (!findTile(tile))
        return;
    const uvec2 pixel = tile * rasterTile + gl_LocalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size)))
        return;
    Visibility visibility = Visibility(uvec2(push.visibility));
    const uint index = sampleIndex(pixel, 0u);
    imageStore(picture, ivec2(pixel), stored(shadeAt(pixel, visibility.at[index]).rgb));
    // Clears the pixel for the next frame. An earlier write would delay all later reads.
    visibility.at[index] = uint64_t(0u);
}
