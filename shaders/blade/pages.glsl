// Maps the places of blades in the field to places in memory. All other code names blades by place in the field.
#ifndef SWARD_BLADE_PAGES_GLSL
#define SWARD_BLADE_PAGES_GLSL

#include "shaders/shared/pages.h"

// A shader where this test costs measurable time may switch it off at pipeline creation.
#ifndef MAY_BE_PAGED
#define MAY_BE_PAGED true
#endif

/// `pages` is the address of Frame::pages: a reference from the frame would be read-only.
uint placeOf(uvec2 pages, uint blade)
{
    return !MAY_BE_PAGED || pages == uvec2(0u) ? blade : UintArray(pages).at[blade / pageBlades] + blade % pageBlades;
}

/// Whether all blades of a patch are in memory.
bool isPresent(uvec2 pages, Patch cell)
{
    return !MAY_BE_PAGED || pages == uvec2(0u) || cell.bladeCount == 0u ||
           (UintArray(pages).at[cell.firstBlade / pageBlades] != noPlace &&
            UintArray(pages).at[(cell.firstBlade + cell.bladeCount - 1u) / pageBlades] != noPlace);
}

#endif
