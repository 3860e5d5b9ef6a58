// A large blade as it is listed.
#ifndef SWARD_LARGE_PART_GLSL
#define SWARD_LARGE_PART_GLSL

#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"

Ribbon ribbonOf(LargePart part)
{
    Ribbon ribbon;
    ribbon.v0 = part.v0;
    ribbon.v1 = part.v1;
    ribbon.v2 = part.v2;
    ribbon.axis = part.axis;
    ribbon.width = part.width;
    ribbon.fold = part.fold;
    ribbon.outline = Outline(part.shape, part.tipThreshold, part.segments, part.scale);
    return ribbon;
}

#endif
