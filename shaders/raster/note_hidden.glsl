// What becomes of the blades that others hide.
#ifndef SWARD_RASTER_NOTE_HIDDEN_GLSL
#define SWARD_RASTER_NOTE_HIDDEN_GLSL

#include "shaders/shared/passes.h"
#include "shaders/grass/pages.glsl"

/// Whether a hidden blade is culled. Without the occlusion test it counts as drawn.
bool cullsHidden()
{
    return (FRAME.view.cullMask & cullOcclusion) != 0u;
}

/// Notes that a blade is hidden, where cull results are recorded; does not count the blade.
void noteHidden(uint blade)
{
    if (cullsHidden() && uvec2(FRAME.cullResults) != uvec2(0u))
        FRAME.cullResults.at[placeOf(uvec2(FRAME.pages), blade)] = cullResultOcclusion;
}

/// Moves so many blades from those that are drawn to those that are hidden. All groups do so at the
/// same address, so each does it once.
void countHidden(uint blades)
{
    if (blades == 0u || !cullsHidden())
        return;
    atomicAdd(FRAME.draw.at[0].cullResults[cullResultDrawn], 0u - blades);
    atomicAdd(FRAME.draw.at[0].cullResults[cullResultOcclusion], blades);
}

#endif
