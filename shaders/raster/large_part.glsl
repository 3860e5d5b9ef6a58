// A large blade in the form of the list.
#ifndef SWARD_RASTER_LARGE_PART_GLSL
#define SWARD_RASTER_LARGE_PART_GLSL

#include "shaders/blade/known_shape.glsl"
#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"

/// A LargePartArray in units of 16 bytes: threads that read a part each need a quarter of the steps.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargePartQuarters
{
    uvec4 at[];
};

void putPart(LargePartArray list, uint place, LargePart part)
{
    LargePartQuarters quarters = LargePartQuarters(uvec2(list));
    quarters.at[5u * place] = uvec4(floatBitsToUint(part.v0), floatBitsToUint(part.width));
    quarters.at[5u * place + 1u] = uvec4(floatBitsToUint(part.v1), floatBitsToUint(part.fold));
    quarters.at[5u * place + 2u] = uvec4(floatBitsToUint(part.v2), part.outline);
    quarters.at[5u * place + 3u] = uvec4(floatBitsToUint(part.axis), floatBitsToUint(part.tipThreshold));
    quarters.at[5u * place + 4u] = uvec4(floatBitsToUint(part.scale), part.instance, part.blade, part.part);
}

LargePart partAt(uint place)
{
    LargePartQuarters quarters = LargePartQuarters(uvec2(push.large));
    const uvec4 a = quarters.at[5u * place];
    const uvec4 b = quarters.at[5u * place + 1u];
    const uvec4 c = quarters.at[5u * place + 2u];
    const uvec4 d = quarters.at[5u * place + 3u];
    const uvec4 e = quarters.at[5u * place + 4u];
    return LargePart(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz),
                     uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), c.w,
                     uintBitsToFloat(d.xyz), uintBitsToFloat(d.w), uintBitsToFloat(e.x), e.y, e.z, e.w);
}

/// Number of listed parts.
uint listedLarge()
{
    return min(push.largeCount.at[largeParts].count, maxLargeParts);
}

/// LargePart::outline.
uint packOutline(uint shape, uint segments, uint seed)
{
    return shape | (segments << 8u) | (seed << 16u);
}

uint shapeOfOutline(uint outline)
{
    return outline & 0xffu;
}

uint segmentsOfOutline(uint outline)
{
    return (outline >> 8u) & 0xffu;
}

uint seedOfOutline(uint outline)
{
    return outline >> 16u;
}

/// Number of the part; argument: LargePart::part.
uint numberOfPart(uint part)
{
    return part & 0xffu;
}

/// Number of the blade's parts; argument: LargePart::part; 0: nothing is listed.
uint partsOf(uint part)
{
    return (part >> 8u) & 0xffu;
}

/// The first drawn segment, and one past the last; argument: LargePart::part.
uvec2 segmentsOfPart(uint part)
{
    return uvec2(part >> 16u, part >> 23u) & 0x7fu;
}

Ribbon ribbonOf(LargePart part)
{
    Ribbon ribbon;
    ribbon.v0 = part.v0;
    ribbon.v1 = part.v1;
    ribbon.v2 = part.v2;
    ribbon.axis = part.axis;
    ribbon.width = part.width;
    ribbon.fold = part.fold;
    ribbon.outline = Outline(knownShape(shapeOfOutline(part.outline)), part.tipThreshold,
                             float(segmentsOfOutline(part.outline)), part.scale);
    ribbon.seed = seedOfOutline(part.outline);
    return ribbon;
}

#endif
