// Shades what a visibility holds.
#include "shaders/grass/blade_colors.glsl"
#include "shaders/grass/blade_light.glsl"
#include "shaders/raster/seen_place.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/sky/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

/// Whether grass that others hide is left out, see layerShare(); known when the pipeline is made.
layout(constant_id = 8) const bool leavesLayers = true;

// Whether there may be blades in a work-group's tile, and sky; known when the pipeline is made.
layout(constant_id = 12) const bool showsBlades = true;
layout(constant_id = 13) const bool showsSky = true;

/// Index of the patch that owns a blade.
uint patchOf(uint blade)
{
    uint owner = push.firstOwners.at[blade / ownerStride];
    uint patchIndex = push.owners.at[owner];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.owners.at[++owner];
    return patchIndex;
}

/// A blade of patch `patchIndex`, raised() by its layers, as the list of visible blades had it.
VisibleBlade visibleBlade(uint index, uint patchIndex, Patch cell, Blade blade, Layers layers)
{
    const Eyepoint view = push.judged.at[0].view;
    const DrawnSize size = drawnSize(view, layers, blade, bladeRank(cell, index - cell.firstBlade),
                                     length(blade.root - view.eye));
    return VisibleBlade(index, patchIndex, packFactors(size.widthFactor, layers.rise), size.pixels);
}

/// What of a blade all pixels ask for that show it.
struct SeenBlade {
    Ribbon ribbon;
    BladeSurface surface;
    uint blade;   ///< resident id
    bool isAsked; ///< whether its halves count as seen in the next frame
};

SeenBlade seenBlade(uint index)
{
    // Read first: to find the patch takes as long.
    const uint place = placeOf(uvec2(FRAME.pages), index);
    const PackedBlade bits = FRAME.blades.at[place];
    const BladeState state = BladeState(FRAME.states.at[place], 0.0);
    const uint patchIndex = patchOf(index);
    const Patch cell = FRAME.patches.at[patchIndex];
    Layers layers = allLayers();
    if (leavesLayers)
        layers = layersOf(push.judged.at[0].view, cell);
    const Blade blade = raised(unpackBlade(bits, cell), layers.rise);
    const VisibleBlade visible = visibleBlade(index, patchIndex, cell, blade, layers);
    const DrawnBlade drawn = drawnBlade(visible, blade, state);
    SeenBlade seen;
    seen.ribbon = drawn.ribbon;
    seen.surface = bladeSurface(drawn, visible, layers);
    seen.blade = index;
    seen.isAsked = uvec2(push.seen) != uvec2(0u) &&
                   pixelsCovered(blade, visible.pixels, widthFactorOf(visible)) > askedSmallPixels;
    return seen;
}

/// In the next frame one half of the blade counts as seen, if that is asked of it. `along`: 0 at its root.
void noteSeen(SeenBlade blade, float along)
{
    if (!blade.isAsked)
        return;
    UintArray seen = push.seen;
    const float segments = blade.ribbon.outline.segments;
    const uint half_ = along * segments < floor(0.5 * segments) ? 0u : 1u;
    const uint word = blade.blade / 16u;
    const uint bit = 1u << (2u * (blade.blade % 16u) + half_);
    if ((seen.at[word] & bit) == 0u)
        atomicOr(seen.at[word], bit);
}

/// What the film sees of a blade in the middle of the samples of a pixel, as bits, at which it is
/// seen, and 1 − softness. It lies at `depth` at one of them, `s`.
vec4 shade(Lens lens, SeenBlade seen, vec2 pixel, uint samples, uint s, float depth)
{
    const Ribbon ribbon = seen.ribbon;
    const Sighting sighting = Sighting(pixel + samplePlace(s), depth, pixel + middleOf(samples));
    const Found found = find(lens, ribbon, sighting);
    noteSeen(seen, found.place.y);
    BladePoint point;
    point.position = found.point;
    point.place = found.place;
    point.tangent = tangentAt(ribbon, point.place.y);
    point.axis = ribbon.axis;
    point.up = normalize(ribbon.v1 - ribbon.v0);
    point.fold = ribbon.fold;
    point.rootColor = seen.surface.root;
    point.tipColor = seen.surface.tip;
    point.material = seen.surface.material;
    return vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - point.position), 1.0));
}

/// What the film sees of the sky at a pixel.
vec4 skyAt(Lens lens, uvec2 pixel)
{
    const vec2 middle = vec2(pixel) + 0.5;
    return vec4(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);
}
