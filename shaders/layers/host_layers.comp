#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the layers of the grass in a host's view from its visibility, before that is lit. With several samples per
// pixel, of the nearest one that shows a blade.
#include "shaders/resolve/sight_blade.glsl"
#include "shaders/layers/shown.glsl"
#include "shaders/resolve/ribbon_motion.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

/// Way to the place in the frame before [pixels].
vec2 flowOf(Motion motion, Lens lens, SeenBlade seen, vec2 place)
{
    Moved moved;
    moved.now = vec4(pointAt(lens, seen.ribbon, place), 1.0);
    moved.before = vec4(pointAt(lens, ribbonBefore(motion, seen), place), 1.0);
    moved.isKnown = true;
    return wayBetween(moved, lens.viewProjection * moved.now, motion.clipBefore * moved.before);
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, host.size)))
        return;
    beginInstances();
    LayersTableArray tables = LayersTableArray(uvec2(host.layers));
    LayersTable table = tables.at[0];
    VisibilityArray visibility = host.visibility;
    const uint index = pixel.y * host.size.x + pixel.x;
    uint what = 0u;
    uint nearest = 0u;
    uint depth = 0u;
    uint covered = 0u;
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        const uvec2 word = visibility.at[sampleIndex(pixel, s)];
        if (word.x == 0u)
            continue;
        ++covered;
        if (what == 0u || word.y >= depth) {
            what = word.x;
            depth = word.y;
            nearest = s;
        }
    }
    if (what == 0u) {
        putShown(table, lensOf(), index, skyShown(lensOf(), vec2(pixel) + 0.5), 0.0, 1.0);
        if (isWanted(uvec2(table.flows)))
            putFlow(table.flows, index, vec2(uintBitsToFloat(unknown)));
        return;
    }
    const SightedBlade blade = sightBlade(pixel, what, 1u << nearest, nearest, uintBitsToFloat(depth));
    const LayersInstance stands = table.instances.at[blade.instance];
    Shown shown = shownOf(blade.lens, blade.seen, blade.found);
    shown.instance = blade.instance;
    shown.normal = mat3(stands.right, stands.up, stands.back) * shown.normal;
    putShown(table, blade.lens, index, shown, float(covered) / float(samplesPerPixel), stands.scale);
    if (isWanted(uvec2(table.flows)))
        putFlow(table.flows, index,
                flowOf(host.instances.at[blade.instance].motion.at[0], blade.lens, blade.seen, shown.place));
}
