// Makes the picture of a visibility: lights each blade once for all samples of a pixel that show it, the sky, and takes
// the light of the ground. Linear light, and 1 − softness.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/raster/visibility.glsl"
#include "shaders/resolve/shade_found.glsl"
#include "shaders/common/sky_light.glsl"
#include "shaders/resolve/half_rounded.glsl"
#include "web/shaders/webgpu/seen_samples.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 21) uniform texture2DMS groundLight;
layout(binding = 22, rgba16f) uniform image2D resolved;

const uint gatherTile = 8u;
#include "shaders/resolve/gather.glsl"

/// A blade of the list of visible ones.
SeenBlade listedBlade(uint place)
{
    const VisibleBlade item = visible[place];
    const DrawnBlade drawn = drawnBlade(item);
    SeenBlade seen;
    seen.ribbon = drawn.ribbon;
    seen.surface = bladeSurface(drawn, item, leafAreaLimitOf(FRAME.view, patches[item.patchIndex]));
    return seen;
}

void main()
{
    const Lens lens = lensOf();
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 tile = gl_WorkGroupID.xy;
    const uvec2 pixel = pixelOf(tile, thread);
    const bool isInside = all(lessThan(pixel, push.size));
    if (thread == 0u)
        gatheredCount = 0u;
    barrier();
    uint seen[samplesPerPixel];
    uint leaders = 0u;
    if (isInside) {
        for (uint s = 0u; s < samplesPerPixel; ++s)
            seen[s] = seenSamples[sampleIndex(pixel, s)].x;
        leaders = gatherTasks(thread, seen, push.firstBlade, ~0u);
    }
    barrier();
    for (uint i = thread; i < gatheredCount; i += gatherThreads) {
        const ShadingTask task = taskAt(i);
        const uvec2 place = pixelOf(tile, task.thread);
        const uvec2 sample_ = seenSamples[sampleIndex(place, task.s)];
        const SeenBlade blade = listedBlade(sample_.x - push.firstBlade);
        const Sighting sighting = Sighting(vec2(place) + samplePlace(task.s), uintBitsToFloat(sample_.y),
                                           vec2(place) + middleOf(task.samples));
        putLight(task, shadeFound(blade, find(lens, blade.ribbon, sighting)));
    }
    barrier();
    if (!isInside)
        return;
    vec4 sum = sumOfLight(thread, leaders);
    float sky = 0.0;
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        if (seen[s] >= push.firstBlade)
            continue;
        if (seenSamples[sampleIndex(pixel, s)].y == 0u)
            sky += 1.0;
        else
            sum += texelFetch(groundLight, ivec2(pixel), int(s));
    }
    if (sky > 0.0) {
        const vec2 middle = vec2(pixel) + 0.5;
        sum += sky * vec4(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);
    }
    imageStore(resolved, ivec2(pixel), halfRounded(sum / float(samplesPerPixel)));
}
