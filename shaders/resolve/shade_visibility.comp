#version 460
#extension GL_GOOGLE_include_directive : require
// Lights the visibility of a host's view: a blade's light replaces its id.
#include "shaders/resolve/sight_blade.glsl"
#include "shaders/resolve/ribbon_motion.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

vec2 motionOf(Motion motion, Lens lens, SeenBlade seen, Found found)
{
    const vec4 before = motion.clipBefore * vec4(pointAt(lens, ribbonBefore(motion, seen), found.place), 1.0);
    const vec4 now = lens.viewProjection * vec4(pointAt(lens, seen.ribbon, found.place), 1.0);
    return 0.5 * (before.xy / before.w - now.xy / now.w);
}

/// Lights one blade at a pixel. `samples`: bits of the samples that show it; `depth`: at sample `middle` of these.
void lightBlade(uvec2 pixel, uint what, uint samples, uint middle, float depth)
{
    const SightedBlade blade = sightBlade(pixel, what, samples, middle, depth);
    const uint light = packLight(shadeFound(blade.seen, blade.found).rgb);
    uint moved = 0u;
    if (uvec2(host.motions) != uvec2(0u))
        moved = packHalf2x16(
            motionOf(host.instances.at[blade.instance].motion.at[0], blade.lens, blade.seen, blade.found));
    VisibilityHalves visibility = VisibilityHalves(uvec2(host.visibility));
    UintArray motions = host.motions;
    const uint first = sampleIndex(pixel, 0u);
    for (uint s = 0u; s < samplesPerPixel; ++s)
        if ((samples & (1u << s)) != 0u) {
            visibility.at[2u * (first + s)] = light;
            if (uvec2(host.motions) != uvec2(0u))
                motions.at[first + s] = moved;
        }
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, host.size)))
        return;
    beginInstances();
    VisibilityHalves visibility = VisibilityHalves(uvec2(host.visibility));
    const uint first = sampleIndex(pixel, 0u);
    uint seen[samplesPerPixel];
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        seen[s] = visibility.at[2u * (first + s)];
    uint anySeen = 0u;
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        anySeen |= seen[s];
    if (anySeen == 0u)
        return;
    noteTile(pixel);
    // Light each blade once for all samples that show it, at the middle one: see gather.glsl.
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        uint samples = 0u;
        SHARED_UNROLL for (uint other = 0u; other < samplesPerPixel; ++other)
            samples |= seen[other] == seen[s] ? 1u << other : 0u;
        if (seen[s] != 0u && bitCount(samples & ((1u << s) - 1u)) == bitCount(samples) / 2)
            lightBlade(pixel, seen[s], samples, s, uintBitsToFloat(visibility.at[2u * (first + s) + 1u]));
    }
}
