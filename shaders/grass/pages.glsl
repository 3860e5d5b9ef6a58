// Where blades lie in memory, by their places in the field: that is what names them everywhere else.
#ifndef SWARD_PAGES_GLSL
#define SWARD_PAGES_GLSL

#include "shaders/shared/pages.h"

// A shader in which the question itself shows may know when its pipeline is made that it need not be
// asked.
#ifndef MAY_BE_PAGED
#define MAY_BE_PAGED true
#endif

/// `pages` is the address of Frame::pages: a reference would be one that nobody writes to.
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
