// Cull results of blades that other blades hide.
#ifndef SWARD_RASTER_NOTE_HIDDEN_GLSL
#define SWARD_RASTER_NOTE_HIDDEN_GLSL

#include "shaders/shared/passes.h"
#include "shaders/blade/pages.glsl"

/// Whether a hidden blade is culled. Without the occlusion test it counts as drawn.
bool cullsHidden()
{
    return (FRAME.view.cullMask & cullOcclusion) != 0u;
}

/// Records that a blade is hidden, where cull results are recorded; does not count the blade.
void noteHidden(uint blade)
{
    if (cullsHidden() && uvec2(FRAME.cullResults) != uvec2(0u))
        FRAME.cullResults.at[placeOf(uvec2(FRAME.pages), blade)] = cullResultOcclusion;
}

/// Moves `blades` blades from the drawn to the hidden count. Each group does so once, because all groups add at the
/// same address.
void countHidden(uint blades)
{
    if (blades == 0u || !cullsHidden())
        return;
    atomicAdd(FRAME.draw.at[0].cullResults[cullResultDrawn], 0u - blades);
    atomicAdd(FRAME.draw.at[0].cullResults[cullResultOcclusion], blades);
}

#endif
