// A tile of pixels is shaded by as many threads. What is to be shaded gathers first, for one pixel shows
// one thing and the next one four, or none: a thread for each pixel would wait for its neighbours. The
// including stage says how wide its tiles are, by `gatherTile`.
#ifndef SWARD_RASTER_GATHER_GLSL
#define SWARD_RASTER_GATHER_GLSL

#include "shaders/raster/visibility.glsl"

const uint gatherThreads = gatherTile * gatherTile;

shared uint gathered[samplesPerPixel * gatherThreads]; // see questionAt()
shared uint gatheredCount;
shared vec4 answers[samplesPerPixel * gatherThreads]; // by pixel and sample

uvec2 pixelOf(uvec2 tile, uint thread)
{
    return tile * gatherTile + uvec2(thread % gatherTile, thread / gatherTile);
}

/// What one pixel shows in some of its samples.
struct Question {
    uint thread;  ///< of the pixel
    uint s;       ///< one of the samples
    uint samples; ///< all of them, as bits
};

Question questionAt(uint i)
{
    return Question(gathered[i] & 0xffu, (gathered[i] >> 8u) & 0xffu, gathered[i] >> 16u);
}

/// Asks once for each thing that a pixel shows, for all samples that show it. `seen`: see
/// VisibilityArray; only what is not below `first` and below `end` is asked for. The samples of a blade
/// lie in the order of rows: the middle one is taken, since the first would be nearer to the tip than
/// what is seen. Returns the samples that were asked for, as bits.
uint ask(uint thread, uint seen[samplesPerPixel], uint first, uint end)
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

/// `light`: of each of the samples.
void answer(Question question, vec4 light)
{
    answers[samplesPerPixel * question.thread + question.s] =
        float(bitCount(question.samples)) * light;
}

/// The sum over all samples for which a pixel has asked.
vec4 answered(uint thread, uint leaders)
{
    vec4 sum = vec4(0.0);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((leaders & (1u << s)) != 0u)
            sum += answers[samplesPerPixel * thread + s];
    return sum;
}

#endif
