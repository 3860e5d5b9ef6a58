// Shading data of a visible blade, found by its resident id. The including stage has a push constant `push` of type
// RasterPush.
#ifndef SWARD_RASTER_SEEN_BLADE_GLSL
#define SWARD_RASTER_SEEN_BLADE_GLSL

#include "shaders/blade/blade_colors.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"

/// Whether the leaf-area limit leaves out hidden grass, see leafAreaShare(); known at pipeline creation.
layout(constant_id = idLimitsLeafArea) const bool limitsLeafArea = true;

/// Index of the patch that contains a blade.
uint patchOf(uint blade)
{
    uint listed = push.firstNonEmptyPatches.at[blade / nonEmptyPatchStride];
    uint patchIndex = push.nonEmptyPatches.at[listed];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.nonEmptyPatches.at[++listed];
    return patchIndex;
}

/// A blade of patch `patchIndex`, raised() by its limit, as in the list of visible blades.
VisibleBlade visibleBlade(uint index, uint patchIndex, Patch cell, PosedLook part, LeafAreaLimit limit)
{
    const Eyepoint view = push.cullView.at[0].view;
    const Blade blade = part.posed.blade;
    const uint i = index - cell.firstBlade;
    const DrawnSize size = drawnSize(view, limit, blade, bladeRank(cell, i - min(part.number, i)),
                                     length(blade.root - view.eye));
    return VisibleBlade(index, patchIndex, packFactors(size.widthFactor, limit.height), size.pixels);
}

/// SeenBlade::patchIndex of a blade from the shading cache.
const uint unknownPatch = ~0u;

/// The data of a blade that all of its visible pixels share.
struct SeenBlade {
    Ribbon ribbon;
    BladeSurface surface;
    uint blade;      ///< resident id
    uint patchIndex; ///< patch that contains it, or unknownPatch
    bool hasHistory; ///< whether the visibility history stores its quarters, see RasterPush::history
};

/// Computes pose and colours from the stored blade.
SeenBlade freshBlade(uint index)
{
    // Start these reads first: finding the patch takes as long, and both overlap.
    const uint place = placeOf(uvec2(FRAME.pages), index);
    const PackedBlade bits = FRAME.blades.at[place];
    const BladeState state = BladeState(FRAME.states.at[place], 0.0);
    const uint patchIndex = patchOf(index);
    const Patch cell = FRAME.patches.at[patchIndex];
    LeafAreaLimit limit = noLeafAreaLimit();
    if (limitsLeafArea)
        limit = leafAreaLimitOf(push.cullView.at[0].view, cell);
    const PosedLook part = posedLook(raised(unpackBlade(bits, cell), limit.height), state);
    const VisibleBlade visible = visibleBlade(index, patchIndex, cell, part, limit);
    const DrawnBlade drawn = drawnBlade(visible, part);
    SeenBlade seen;
    seen.ribbon = drawn.ribbon;
    seen.surface = bladeSurface(drawn, visible, limit);
    seen.blade = index;
    seen.patchIndex = patchIndex;
    seen.hasHistory = uvec2(push.history) != uvec2(0u) &&
                      pixelsCovered(part.posed.blade, visible.pixels, widthFactorOf(visible)) > testedSmallPixels;
    return seen;
}

#endif
