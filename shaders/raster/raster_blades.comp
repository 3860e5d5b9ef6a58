#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades of the early pass, one thread each. Blades that cover many pixels are listed for
// raster_large.comp; on a CPU, those with too many pixels for a thread are listed for raster_cut.comp. Blades that
// reach through the near plane are listed for raster_cut.comp, too.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether only some blades may be in memory; known at pipeline creation.
layout(constant_id = idIsPaged) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#include "shaders/raster/draw_alone.glsl"

layout(local_size_x = rasterThreads) in;

// The large blades that the group lists together: number of their parts, and first place in the list.
shared uint listedParts;
shared uint listBase;

// Unit that draws large blades; known at pipeline creation.
layout(constant_id = idLargeTo) const uint largeTo = largeToGroups;
const bool isLate = false;

#include "shaders/raster/large_list.glsl"

/// Upper bound of the pixels of a ribbon of this height [m] behind the near plane. Assumes that all of it is as near as
/// its nearest control point and shows its broad side.
float pixelsAtMost(Lens lens, Ribbon ribbon, float height)
{
    const mat4 m = lens.viewProjection;
    const vec4 depth = vec4(m[0].w, m[1].w, m[2].w, m[3].w);
    const vec3 depths = vec3(dot(depth, vec4(ribbon.v0, 1.0)), dot(depth, vec4(ribbon.v1, 1.0)),
                             dot(depth, vec4(ribbon.v2, 1.0)));
    const float wide = outlineMost * ribbon.width;
    const float nearest = min(min(depths.x, depths.y), depths.z) - 0.5 * wide;
    const float scale = FRAME.view.pixelsPerUnit / max(nearest, 1e-6);
    return height * scale * max(wide * scale, lens.minWidth * FRAME.view.pixelsPerUnit);
}

/// A blade of this iteration.
struct OwnBlade {
    VisibleBlade visible;
    Ribbon ribbon;
    bool isDrawn;   ///< by this thread, unless it is listed
    uint parts;     ///< 0: not listed
    uvec2 segments; ///< segments of the early pass; see firstSegments()
};

/// Prepares a blade that covers `pixels` pixels for the list of the work-groups.
void leaveToOthers(inout OwnBlade own, float pixels)
{
    own.parts = partsFor(pixels);
    // Blades of later rounds are listed after the early pass, with all segments.
    const uint late = push.round > 0u ? 0u : own.visible.factors >> lateShift;
    own.segments = firstSegments(late, uint(own.ribbon.outline.segments));
}

OwnBlade ownBlade(Lens lens, VisibleBlade visible)
{
    OwnBlade own;
    own.visible = visible;
    own.isDrawn = false;
    own.parts = 0u;
    own.segments = uvec2(0u);
    // Read together with the blade, to wait only once.
    const BladeState state = stateOf(visible);
    const Blade blade = visibleBlade(visible);
    if (listsThoseBeside() && isFarBeside(lens, visible, blade))
        return own;
    const DrawnBlade drawn = drawnBlade(visible, blade, state);
    own.ribbon = drawn.ribbon;
    const float height = drawn.blade.height;
    const float margin = marginBeside(own.ribbon.width, length(own.ribbon.v0 - lens.eye) + height,
                                      lens.minWidth);
    if (listsThoseBeside() && isBeside(own.ribbon, margin))
        return own;
    const float pixels = pixelsOf(lens, visible, own.ribbon, height);
    const bool mayBeCut =
        !curveInside(FRAME.view.planes[4], own.ribbon.v0, own.ribbon.v1, own.ribbon.v2, margin);
    if (mayBeCut) {
        leftToBeCut(own.ribbon, visible.blade);
        return own;
    }
    // A pixel of four samples costs a thread twice as much as a pixel of one.
    if (largeTo != largeToNone && pixels > largeBladePixels * inversesqrt(float(samplesPerPixel)))
        leaveToOthers(own, pixels);
    if (largeTo == largeToNone && pixelsAtMost(lens, own.ribbon, height) > maxPixelsOfThread &&
        leftToBeCut(own.ribbon, visible.blade))
        return own;
    own.isDrawn = true;
    return own;
}

/// All threads call this together, each with a blade or none. One atomic reserves their places in the list.
void rasterise(Lens lens, bool hasBlade, uint place)
{
    const uint thread = gl_LocalInvocationIndex;
    const bool areListed = largeTo != largeToNone;
    if (areListed) {
        if (thread == 0u)
            listedParts = 0u;
        barrier();
    }
    OwnBlade own;
    own.isDrawn = false;
    own.parts = 0u;
    if (hasBlade)
        own = ownBlade(lens, FRAME.visible.at[place]);
    if (areListed) {
        uint before = 0u;
        if (own.parts > 0u)
            before = atomicAdd(listedParts, own.parts);
        barrier();
        if (thread == 0u && listedParts > 0u) {
            WalkLevelArray lists = push.largeCount;
            listBase = atomicAdd(lists.at[largeParts].count, listedParts);
            noteListed(listBase + listedParts);
        }
        barrier();
        if (own.parts > 0u && putParts(own.ribbon, own.visible, listBase + before, own.parts, own.segments))
            own.isDrawn = false;
    }
    if (own.isDrawn)
        drawAlone(lens, own.ribbon, own.visible.blade);
}

void main()
{
    const uint capacity = FRAME.visibleCapacity;
    const uint count = min(push.rounds.at[push.round].count, capacity);
    const Lens lens = lensOf();
    for (uint first = gl_WorkGroupID.x * rasterThreads; first < count;
         first += gl_NumWorkGroups.x * rasterThreads)
        rasterise(lens, first + gl_LocalInvocationIndex < count, first + gl_LocalInvocationIndex);
}
