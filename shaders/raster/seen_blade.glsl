// What shading asks of a blade that the visibility shows, found by its resident id. The including stage has
// a push constant `push` of type RasterPush.
#ifndef SWARD_RASTER_SEEN_BLADE_GLSL
#define SWARD_RASTER_SEEN_BLADE_GLSL

#include "shaders/grass/blade_colors.glsl"
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"

/// Whether grass that others hide is left out, see leafAreaShare(); known when the pipeline is made.
layout(constant_id = 8) const bool limitsLeafArea = true;

/// Index of the patch that owns a blade.
uint patchOf(uint blade)
{
    uint owner = push.firstNonEmptyPatches.at[blade / nonEmptyPatchStride];
    uint patchIndex = push.nonEmptyPatches.at[owner];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.nonEmptyPatches.at[++owner];
    return patchIndex;
}

/// A blade of patch `patchIndex`, raised() by its limit, as the list of visible blades had it.
VisibleBlade visibleBlade(uint index, uint patchIndex, Patch cell, Blade blade, LeafAreaLimit limit)
{
    const Eyepoint view = push.cullView.at[0].view;
    const DrawnSize size = drawnSize(view, limit, blade, bladeRank(cell, index - cell.firstBlade),
                                     length(blade.root - view.eye));
    return VisibleBlade(index, patchIndex, packFactors(size.widthFactor, limit.height), size.pixels);
}

/// What of a blade all pixels ask for that show it.
struct SeenBlade {
    Ribbon ribbon;
    BladeSurface surface;
    uint blade;      ///< resident id
    uint patchIndex; ///< of the patch that owns it, if freshBlade() has found it
    bool hasHistory; ///< whether its quarters are noted in the visibility history, see RasterPush::seen
};

/// Posed and coloured from what is stored of it.
SeenBlade freshBlade(uint index)
{
    // Read first: to find the patch takes as long.
    const uint place = placeOf(uvec2(FRAME.pages), index);
    const PackedBlade bits = FRAME.blades.at[place];
    const BladeState state = BladeState(FRAME.states.at[place], 0.0);
    const uint patchIndex = patchOf(index);
    const Patch cell = FRAME.patches.at[patchIndex];
    LeafAreaLimit limit = noLeafAreaLimit();
    if (limitsLeafArea)
        limit = leafAreaLimitOf(push.cullView.at[0].view, cell);
    const Blade blade = raised(unpackBlade(bits, cell), limit.height);
    const VisibleBlade visible = visibleBlade(index, patchIndex, cell, blade, limit);
    const DrawnBlade drawn = drawnBlade(visible, blade, state);
    SeenBlade seen;
    seen.ribbon = drawn.ribbon;
    seen.surface = bladeSurface(drawn, visible, limit);
    seen.blade = index;
    seen.patchIndex = patchIndex;
    seen.hasHistory = uvec2(push.seen) != uvec2(0u) &&
                      pixelsCovered(blade, visible.pixels, widthFactorOf(visible)) > testedSmallPixels;
    return seen;
}

#endif
