#version 460
#extension GL_GOOGLE_include_directive : require
// Lights the visibility of a host's view and stores the light into the host's picture: see StoredPicture. The set of
// the stored colour follows that of the shadow map, and then comes that of the stored depth.
#include "shaders/resolve/sight_blade.glsl"
#include "shaders/shared/look/film_curve.h"
#include "shaders/resolve/stored.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

const uint gatherTile = rasterTile;
#include "shaders/resolve/gather.glsl"
#include "shaders/shared/constants.h"

layout(set = HOST_LIGHT + 1, binding = 1, STORED_FORMAT) uniform image2D hostColor;
layout(set = HOST_LIGHT + 2, binding = 1, r32f) uniform writeonly image2D hostDepth; // only with storesDepth

/// Flags of storesPicture …; known at pipeline creation.
layout(constant_id = idStoredAs) const uint storedAs = storesPicture;

bool isStoredAs(uint flag)
{
    return (storedAs & flag) != 0u;
}

/// The host's colour at a place: linear, red first.
vec4 loadedColor(ivec2 at)
{
    const vec4 bits = imageLoad(hostColor, at);
    const vec3 color = isStoredAs(storesBgr) ? bits.bgr : bits.rgb;
    return vec4(isStoredAs(storesSrgb) ? decodeSrgb(color) : color, bits.a);
}

void storeColor(ivec2 at, vec4 color)
{
    const vec3 encoded = isStoredAs(storesSrgb) ? encodeSrgb(color.rgb) : color.rgb;
    imageStore(hostColor, at, vec4(isStoredAs(storesBgr) ? encoded.bgr : encoded, color.a));
}

/// The picture of one blade at a pixel, opaque: see sightBlade().
vec4 pictureOf(uvec2 pixel, uint what, uint samples, uint middle, float depth)
{
    const SightedBlade blade = sightBlade(pixel, what, samples, middle, depth);
    const vec3 light = boundedLight(shadeFound(blade.seen, blade.found).rgb);
    return vec4(isStoredAs(storesDeveloped) ? filmOf(light) : light, 1.0);
}

/// Stores the blades of a pixel. `sum`: of pictureOf() over the samples that show blades; `depth`: of the nearest of
/// these samples.
void storePixel(uvec2 pixel, vec4 sum, float depth)
{
    const ivec2 at = ivec2(host.firstStored + pixel);
    vec4 mean = sum / float(samplesPerPixel);
    // All other samples have the host's colour.
    if (samplesPerPixel > 1u && mean.a < 1.0)
        mean += (1.0 - mean.a) * loadedColor(at);
    storeColor(at, mean);
    if (isStoredAs(storesDepth))
        imageStore(hostDepth, at, vec4(isStoredAs(storesForwardZ) ? 1.0 - depth : depth));
}

/// Value and reversed depth of a sample.
uvec2 wordAt(uvec2 pixel, uint s)
{
    VisibilityArray visibility = host.visibility;
    return visibility.at[sampleIndex(pixel, s)];
}

void storeOne(uvec2 pixel)
{
    const uvec2 word = wordAt(pixel, 0u);
    if (word.x == 0u)
        return;
    noteTile(pixel);
    const float depth = uintBitsToFloat(word.y);
    storePixel(pixel, pictureOf(pixel, word.x, 1u, 0u, depth), depth);
}

/// Lights each blade of a pixel once. The threads of a tile share these tasks: see gather.glsl.
void storeSeveral(uvec2 tile, uint thread, bool isInside)
{
    if (thread == 0u)
        gatheredCount = 0u;
    barrier();
    const uvec2 pixel = pixelOf(tile, thread);
    uint leaders = 0u;
    float nearest = 0.0;
    if (isInside) {
        uint seen[samplesPerPixel];
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
            const uvec2 word = wordAt(pixel, s);
            seen[s] = word.x;
            nearest = max(nearest, word.x != 0u ? uintBitsToFloat(word.y) : 0.0);
        }
        leaders = gatherTasks(thread, seen, 1u, ~0u);
        if (leaders != 0u)
            noteTile(pixel);
    }
    barrier();
    for (uint i = thread; i < gatheredCount; i += gatherThreads) {
        const ShadingTask task = taskAt(i);
        const uvec2 place = pixelOf(tile, task.thread);
        const uvec2 word = wordAt(place, task.s);
        putLight(task, pictureOf(place, word.x, task.samples, task.s, uintBitsToFloat(word.y)));
    }
    barrier();
    if (leaders != 0u)
        storePixel(pixel, sumOfLight(thread, leaders), nearest);
}

void main()
{
    const uvec2 pixel = gl_WorkGroupID.xy * rasterTile + gl_LocalInvocationID.xy;
    const bool isInside = all(lessThan(pixel, host.size));
    beginInstances();
    if (samplesPerPixel > 1u)
        storeSeveral(gl_WorkGroupID.xy, gl_LocalInvocationIndex, isInside);
    else if (isInside)
        storeOne(pixel);
}
