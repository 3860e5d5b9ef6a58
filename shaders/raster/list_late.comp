#version 460
#extension GL_GOOGLE_include_directive : require
// Lists the blades of the late pass, which all cover many pixels, for raster_late.comp. One thread per blade; skips
// blades that the frame's pyramid hides completely.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether only some blades may be in memory; known at pipeline creation.
layout(constant_id = idIsPaged) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"

const bool isLate = true;

#include "shaders/raster/draw_alone.glsl"
#include "shaders/raster/large_list.glsl"
#include "shaders/raster/note_hidden.glsl"
#include "shaders/raster/seen_segments.glsl"

layout(local_size_x = rasterThreads) in;

shared uint hiddenCount; // over all blades of the group
shared uint listedParts; // over the blades of this iteration
shared uint listBase;    // their first place in the list

/// A blade of this iteration.
struct LateBlade {
    VisibleBlade visible;
    Ribbon ribbon;
    float pixels;   ///< covered pixels
    uvec2 segments; ///< the first potentially visible one, and one past the last; 0: nothing to list
};

LateBlade lateBlade(Lens lens, VisibleBlade visible)
{
    LateBlade own;
    own.visible = visible;
    own.segments = uvec2(0u);
    // Read together with the blade, to wait only once.
    const BladeState state = stateOf(visible);
    const Blade blade = visibleBlade(visible);
    if (listsThoseBeside() && isFarBeside(lens, visible, blade))
        return own;
    const DrawnBlade drawn = drawnBlade(visible, blade, state);
    own.ribbon = drawn.ribbon;
    const float distance = length(own.ribbon.v0 - lens.eye) + drawn.blade.height;
    const float margin = marginBeside(own.ribbon.width, distance, lens.minWidth);
    if (listsThoseBeside() && isBeside(own.ribbon, margin))
        return own;
    own.pixels = pixelsOf(lens, visible, own.ribbon, drawn.blade.height);
    if (!curveInside(FRAME.view.planes[4], own.ribbon.v0, own.ribbon.v1, own.ribbon.v2, margin)) {
        leftToBeCut(own.ribbon, visible.blade);
        return own;
    }
    own.segments = segmentsSeen(lens, own.ribbon, sectionMargin(distance, lens.minWidth));
    if (own.segments.y == 0u) {
        noteHidden(visible.blade);
        atomicAdd(hiddenCount, 1u);
    }
    return own;
}

/// Lists the potentially visible parts of a group's blades. All threads call this together, each with one blade or
/// none. One atomic reserves their places, and they write side by side. If each lane reserved its own places, an H200
/// would take three times as long.
void listTogether(Lens lens, bool hasBlade, uint place)
{
    if (gl_LocalInvocationIndex == 0u)
        listedParts = 0u;
    barrier();
    LateBlade own;
    uint parts = 0u;
    uint before = 0u;
    if (hasBlade) {
        own = lateBlade(lens, FRAME.visible.at[place]);
        if (own.segments.y > 0u) {
            parts = partsFor(own.pixels);
            before = atomicAdd(listedParts, parts);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && listedParts > 0u) {
        WalkLevelArray lists = push.largeCount;
        listBase = atomicAdd(lists.at[largeParts].count, listedParts);
        noteListed(listBase + listedParts);
    }
    barrier();
    if (parts > 0u &&
        !putParts(own.ribbon, own.visible, listBase + before, parts, own.segments))
        drawAlone(lens, own.ribbon, own.visible.blade);
    barrier();
}

void main()
{
    const uint capacity = FRAME.visibleCapacity;
    const uint count = min(push.rounds.at[push.round].count, capacity);
    const Lens lens = lensOf();
    if (gl_LocalInvocationIndex == 0u)
        hiddenCount = 0u;
    for (uint first = gl_WorkGroupID.x * rasterThreads; first < count;
         first += gl_NumWorkGroups.x * rasterThreads) {
        const uint i = first + gl_LocalInvocationIndex;
        listTogether(lens, i < count, capacity - 1u - i);
    }
    if (gl_LocalInvocationIndex == 0u)
        countHidden(hiddenCount);
}
