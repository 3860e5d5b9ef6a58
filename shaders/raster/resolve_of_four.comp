#version 460
#extension GL_GOOGLE_include_directive : require
// Shades a visibility of four samples per pixel; soften.comp makes the picture.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };
// Holds what light_solid.comp has lit, and then the whole pixel.
layout(set = 0, binding = 1, rgba16f) uniform image2D shaded;

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/raster/visibility.glsl"

#include "shaders/raster/resolve.glsl"
#include "shaders/raster/half_rounded.glsl"

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

/// Asks for each blade of a pixel once, for all samples that show it. `seen`: see VisibilityArray. They lie in the order of rows:
/// the middle one is taken, since the first would be nearer to the tip than what is seen. Returns the
/// samples that were asked for, as bits.
uint ask(uint thread, uint seen[4])
{
    uint leaders = 0u;
    for (uint s = 0u; s < 4u; ++s) {
        uint samples = 0u;
        for (uint other = 0u; other < 4u; ++other)
            samples |= seen[other] == seen[s] ? 1u << other : 0u;
        if (seen[s] < push.firstBlade || bitCount(samples & ((1u << s) - 1u)) != bitCount(samples) / 2)
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

    uint seen[4] = uint[4](0u, 0u, 0u, 0u);
    uint leaders = 0u;
    if (isInside) {
        for (uint s = 0u; s < 4u; ++s)
            seen[s] = uint(visibility.at[sampleIndex(pixel, s)]);
        leaders = ask(thread, seen);
    }
    barrier();

    for (uint i = thread; i < askedCount; i += tilePixels) {
        const uint own = asked[i] & 0xffu;
        const uint s = (asked[i] >> 8u) & 0xffu;
        const uint samples = asked[i] >> 16u;
        const uint64_t word = visibility.at[sampleIndex(pixelOf(own), s)];
        shades[4u * own + s] = float(bitCount(samples)) *
                               shade(lens, uint(word) - push.firstBlade, vec2(pixelOf(own)), samples, s,
                                     uintBitsToFloat(uint(word >> 32u)));
    }
    barrier();

    if (!isInside)
        return;
    // The next frame begins with nothing.
    for (uint s = 0u; s < 4u; ++s)
        visibility.at[sampleIndex(pixel, s)] = uint64_t(0u);
    vec4 sum = vec4(0.0);
    float sky = 0.0;
    bool seesSolid = false;
    for (uint s = 0u; s < 4u; ++s) {
        if ((leaders & (1u << s)) != 0u)
            sum += shades[4u * thread + s];
        sky += seen[s] == 0u ? 1.0 : 0.0;
        seesSolid = seesSolid || (seen[s] > 0u && seen[s] < push.firstBlade);
    }
    if (sky > 0.0)
        sum += sky * skyAt(lens, pixel);
    vec4 mean = sum / 4.0;
    if (seesSolid)
        mean += imageLoad(shaded, ivec2(pixel));
    imageStore(shaded, ivec2(pixel), halfRounded(mean));
}
