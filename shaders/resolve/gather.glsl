// A tile of pixels is shaded by one thread per pixel. Shading tasks are gathered first, because a pixel has none to
// four of them: with a thread for each pixel's tasks, threads would wait for their neighbours. The including stage
// defines the width of its tiles, `gatherTile`.
#ifndef SWARD_RESOLVE_GATHER_GLSL
#define SWARD_RESOLVE_GATHER_GLSL

#include "shaders/raster/visibility.glsl"

const uint gatherThreads = gatherTile * gatherTile;

shared uint gathered[samplesPerPixel * gatherThreads]; // see taskAt()
shared uint gatheredCount;
shared vec4 lights[samplesPerPixel * gatherThreads]; // by pixel and sample

uvec2 pixelOf(uvec2 tile, uint thread)
{
    return tile * gatherTile + uvec2(thread % gatherTile, thread / gatherTile);
}

/// A blade or surface that one pixel shows in some of its samples.
struct ShadingTask {
    uint thread;  ///< thread of the pixel
    uint s;       ///< one of the samples
    uint samples; ///< bits of all these samples
};

ShadingTask taskAt(uint i)
{
    return ShadingTask(gathered[i] & 0xffu, (gathered[i] >> 8u) & 0xffu, gathered[i] >> 16u);
}

/// Gathers each surface that a pixel shows once, for all samples that show it. `seen`: see VisibilityArray; only values
/// from `first` to below `end` are gathered. A blade's samples are in the order of rows: the middle one is taken,
/// because the first would be biased towards the tip. Returns the gathered samples, as bits.
uint gatherTasks(uint thread, uint seen[samplesPerPixel], uint first, uint end)
{
    uint leaders = 0u;
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
        uint samples = 0u;
        SHARED_UNROLL for (uint other = 0u; other < samplesPerPixel; ++other)
            samples |= seen[other] == seen[s] ? 1u << other : 0u;
        if (seen[s] < first || seen[s] >= end ||
            bitCount(samples & ((1u << s) - 1u)) != bitCount(samples) / 2)
            continue;
        leaders |= 1u << s;
        gathered[atomicAdd(gatheredCount, 1u)] = thread | (s << 8u) | (samples << 16u);
    }
    return leaders;
}

/// `light`: of each sample.
void putLight(ShadingTask task, vec4 light)
{
    lights[samplesPerPixel * task.thread + task.s] =
        float(bitCount(task.samples)) * light;
}

/// The sum over all gathered samples of a pixel.
vec4 sumOfLight(uint thread, uint leaders)
{
    vec4 sum = vec4(0.0);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((leaders & (1u << s)) != 0u)
            sum += lights[samplesPerPixel * thread + s];
    return sum;
}

#endif
