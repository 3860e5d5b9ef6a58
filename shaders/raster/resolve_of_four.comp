#version 460
#extension GL_GOOGLE_include_directive : require
// Shades a visibility of four samples per pixel; soften.comp makes the picture.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
layout(set = 0, binding = 0) uniform sampler2DMS pictures[2]; // colour, depth
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D shaded;

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"

#include "shaders/raster/resolve.glsl"
#include "shaders/raster/stored.glsl"

// What is to be shaded of the tile gathers first, for one pixel shows one blade and the next one four:
// a thread for each pixel would wait for its neighbours.
const uint tilePixels = rasterTile * rasterTile;
shared uint asked[4u * tilePixels]; // the pixel of the tile, the sample and all samples alike, as bits
shared uint askedCount;
shared vec4 shades[4u * tilePixels]; // by pixel and sample, times the samples that it stands for

uvec2 pixelOf(uint thread)
{
    return gl_WorkGroupID.xy * rasterTile + uvec2(thread % rasterTile, thread / rasterTile);
}

/// Asks for each blade of a pixel once, for all samples that show it. They lie in the order of rows:
/// the middle one is taken, since the first would be nearer to the tip than what is seen. Returns the
/// samples that were asked for, as bits.
uint ask(uint thread, uint blades[4])
{
    uint leaders = 0u;
    for (uint s = 0u; s < 4u; ++s) {
        uint samples = 0u;
        for (uint other = 0u; other < 4u; ++other)
            samples |= blades[other] == blades[s] ? 1u << other : 0u;
        if (blades[s] == 0u || bitCount(samples & ((1u << s) - 1u)) != bitCount(samples) / 2)
            continue;
        leaders |= 1u << s;
        asked[atomicAdd(askedCount, 1u)] = thread | (s << 8u) | (samples << 16u);
    }
    return leaders;
}

void main()
{
    Visibility visibility = Visibility(uvec2(push.visibility));
    const Lens lens = lensOf();
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 pixel = pixelOf(thread);
    const bool isInside = all(lessThan(pixel, push.size));
    if (thread == 0u)
        askedCount = 0u;
    barrier();

    uint blades[4] = uint[4](0u, 0u, 0u, 0u);
    float depths[4];
    uint leaders = 0u;
    if (isInside) {
        for (uint s = 0u; s < 4u; ++s) {
            const uint64_t seen = visibility.at[sampleIndex(pixel, s)];
            blades[s] = uint(seen);
            depths[s] = uintBitsToFloat(uint(seen >> 32u));
        }
        leaders = ask(thread, blades);
    }
    barrier();

    for (uint i = thread; i < askedCount; i += tilePixels) {
        const uint own = asked[i] & 0xffu;
        const uint s = (asked[i] >> 8u) & 0xffu;
        const uint samples = asked[i] >> 16u;
        const uint64_t seen = visibility.at[sampleIndex(pixelOf(own), s)];
        shades[4u * own + s] = float(bitCount(samples)) *
                               shade(lens, uint(seen) - 1u, vec2(pixelOf(own)), samples, s,
                                     uintBitsToFloat(uint(seen >> 32u)));
    }
    barrier();

    if (!isInside)
        return;
    vec4 sum = vec4(0.0);
    float sky = 0.0;
    for (uint s = 0u; s < 4u; ++s) {
        if ((leaders & (1u << s)) != 0u)
            sum += shades[4u * thread + s];
        else if (blades[s] == 0u && depths[s] > 0.0)
            sum += texelFetch(pictures[0], ivec2(pixel), int(s));
        else if (blades[s] == 0u)
            sky += 1.0;
    }
    if (sky > 0.0)
        sum += sky * skyAt(lens, pixel);
    imageStore(shaded, ivec2(pixel), halfRounded(sum / 4.0));
}
