// Lists blades that one thread does not draw alone: large ones, and those that reach through the near plane. The
// including stage has `push`; `isLate` says in which pass it lists.
#ifndef SWARD_RASTER_LARGE_LIST_GLSL
#define SWARD_RASTER_LARGE_LIST_GLSL

#include "shaders/blade/drawn_blade.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/visibility.glsl"

/// A blade, or a part of it, in the form of the list. `part`: LargePart::part.
LargePart partOf(Ribbon ribbon, uint blade, uint part)
{
    return LargePart(ribbon.v0, ribbon.width, ribbon.v1, ribbon.fold, ribbon.v2,
                     packOutline(ribbon.outline.shape, uint(ribbon.outline.segments), ribbon.seed),
                     ribbon.axis, ribbon.outline.tipThreshold, ribbon.outline.scale,
                     push.instance, blade, part);
}

/// Number of parts of a blade that covers `pixels` pixels.
uint partsFor(float pixels)
{
    return clamp(uint(pixels / partPixels), 1u, maxParts);
}

/// Lists a blade's parts from `slot` on, with the range of drawn segments; returns whether there was room.
bool putParts(Ribbon ribbon, VisibleBlade visible, uint slot, uint parts, uvec2 segments)
{
    const bool hasRoom = slot + parts <= maxLargeParts;
    for (uint part = 0u; part < parts && slot + part < maxLargeParts; ++part)
        putPart(push.large, slot + part,
                partOf(ribbon, visible.blade,
                       hasRoom ? packPart(part, parts, segments.x, segments.y) : 0u));
    return hasRoom;
}

/// Updates the dispatch sizes for `parts` listed parts, limited to the list's capacity.
void noteListed(uint parts)
{
    WalkLevelArray lists = push.largeCount;
    const uint listed = min(parts, maxLargeParts);
    atomicMax(lists.at[largeParts].groups[0], groupsForLarge(listed));
    if (isLate || push.round > 0u)
        atomicMax(lists.at[largeLate].groups[0], groupsForLate(listed));
}

/// Lists a blade that may reach through the near plane for clipping; returns whether there was room.
bool leftToBeCut(Ribbon ribbon, uint blade)
{
    WalkLevelArray lists = push.largeCount;
    const uint slot = atomicAdd(lists.at[largeCut].count, 1u);
    if (slot >= maxCutBlades)
        return false;
    putPart(push.cut, slot, partOf(ribbon, blade, packPart(0u, 1u, 0u, uint(ribbon.outline.segments))));
    atomicMax(lists.at[largeCut].groups[0], min(slot + 1u, maxGroups));
    return true;
}

/// Whether the list may hold blades outside the picture.
bool listsThoseBeside()
{
    return uvec2(push.frame) != uvec2(push.cullView) || (FRAME.view.cullMask & cullFrustum) == 0u;
}

/// Whether a blade lies outside the picture in any pose. Finds most blades outside, and before their pose is known.
bool isFarBeside(Lens lens, VisibleBlade visible, Blade blade)
{
    const float reach =
        maxReach(blade) + marginBeside(blade.width * widthFactorOf(visible),
                                       length(blade.root - lens.eye) + maxReach(blade), lens.minWidth);
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || planeDistance(FRAME.view.planes[i], blade.root) < -reach;
    return beside;
}

/// Whether a blade lies outside the picture.
bool isBeside(Ribbon ribbon, float margin)
{
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || curveOutside(FRAME.view.planes[i], ribbon.v0, ribbon.v1, ribbon.v2, margin);
    return beside;
}

/// Number of pixels that a blade of this height covers.
float pixelsOf(Lens lens, VisibleBlade visible, Ribbon ribbon, float height)
{
    return visible.pixels *
           max(visible.pixels * ribbon.width / height, lens.minWidth * FRAME.view.pixelsPerUnit);
}

#endif
