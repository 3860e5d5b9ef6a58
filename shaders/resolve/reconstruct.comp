#version 460
#extension GL_GOOGLE_include_directive : require
// Filters the picture's tiles that contain soft pixels, from the shaded pixels.
#include "shaders/shared/passes.h"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;
layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2D shaded;
layout(set = 0, binding = 1, STORED_FORMAT) uniform writeonly image2D picture;

#include "shaders/resolve/stored.glsl"

vec4 pixelAt(ivec2 pixel)
{
    return texelFetch(shaded, clamp(pixel, ivec2(0), ivec2(push.size) - 1), 0);
}

#include "shaders/resolve/reconstruction_filter.glsl"
#include "shaders/resolve/tile_classification.glsl"

void main()
{
    uvec2 tile;
    if (!findTile(tile))
        return;
    const ivec2 pixel = ivec2(tile * rasterTile + gl_LocalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(push.size))))
        imageStore(picture, pixel, stored(reconstructed(pixel)));
}
