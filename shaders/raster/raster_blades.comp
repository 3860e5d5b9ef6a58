#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each, but for those of the late pass. Blades that cover many
// pixels are listed for raster_large.comp; on a CPU those that cover too many for a thread are listed for
// raster_cut.comp. Blades that reach through the near plane are listed for raster_cut.comp, too.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#include "shaders/raster/draw_alone.glsl"

layout(local_size_x = rasterThreads) in;

// Of large blades and of heavy ones that the group lists together: how many parts, and where they begin.
shared uint listedParts[2];
shared uint listBase[2];

// What draws large blades; known when the pipeline is made.
layout(constant_id = 4) const uint largeTo = largeToGroups;
const bool isLate = false;

#include "shaders/raster/large_list.glsl"

/// No more pixels are covered by a ribbon behind the near plane, so high [m], than these: as if all of it
/// were as near as its nearest control point, and seen from its broad side.
float pixelsAtMost(Lens lens, Ribbon ribbon, float height)
{
    const mat4 m = lens.viewProjection;
    const vec4 depth = vec4(m[0].w, m[1].w, m[2].w, m[3].w);
    const vec3 depths = vec3(dot(depth, vec4(ribbon.v0, 1.0)), dot(depth, vec4(ribbon.v1, 1.0)),
                             dot(depth, vec4(ribbon.v2, 1.0)));
    const float wide = outlineMost * ribbon.width;
    const float nearest = min(min(depths.x, depths.y), depths.z) - 0.5 * wide;
    const float scale = FRAME.view.pixelsPerUnit / max(nearest, 1e-6);
    return height * scale * max(wide * scale, lens.leastWidth * FRAME.view.pixelsPerUnit);
}

/// A blade of this turn.
struct OwnBlade {
    VisibleBlade visible;
    Ribbon ribbon;
    bool isDrawn;   ///< by this thread, unless it is listed
    bool isHeavy;
    uint parts;     ///< 0: it is not listed
    uvec2 segments; ///< of which its first turn is; see firstSegments()
};

/// How a blade that covers so many pixels is listed for work-groups.
void leaveToOthers(inout OwnBlade own, float pixels)
{
    own.parts = partsFor(pixels);
    // Those of other rounds than the first are all listed after the first turn.
    const uint late = push.round > 0u ? 0u : own.visible.factors >> lateShift;
    const float segments = own.ribbon.outline.segments;
    own.segments = firstSegments(late, uint(segments));
    const float drawn = pixels * float(own.segments.y - own.segments.x) / segments;
    own.isHeavy = push.round == 0u && drawn > heavyPixels * float(own.parts);
}

OwnBlade ownBlade(Lens lens, VisibleBlade visible)
{
    OwnBlade own;
    own.visible = visible;
    own.isDrawn = false;
    own.isHeavy = false;
    own.parts = 0u;
    own.segments = uvec2(0u);
    // Read with the blade, which it would otherwise be waited for after.
    const BladeState state = stateOf(visible);
    const Blade blade = visibleBlade(visible);
    if (listsThoseBeside() && isFarBeside(lens, visible, blade))
        return own;
    own.ribbon = drawnBlade(visible, blade, state).ribbon;
    const float margin = marginBeside(own.ribbon.width, length(own.ribbon.v0 - lens.eye) + blade.height,
                                      lens.leastWidth);
    if (listsThoseBeside() && isBeside(own.ribbon, margin))
        return own;
    const float pixels = pixelsOf(lens, visible, own.ribbon, blade.height);
    const bool mayBeCut =
        !curveInside(FRAME.view.planes[4], own.ribbon.v0, own.ribbon.v1, own.ribbon.v2, margin);
    if (mayBeCut) {
        leftToBeCut(own.ribbon, visible.blade);
        return own;
    }
    // A thread takes twice as long for a pixel of four samples as for one of one.
    if (largeTo != largeToNobody && pixels > largeBladePixels * inversesqrt(float(samplesPerPixel)))
        leaveToOthers(own, pixels);
    if (largeTo == largeToNobody && pixelsAtMost(lens, own.ribbon, blade.height) > mostPixelsOfThread &&
        leftToBeCut(own.ribbon, visible.blade))
        return own;
    own.isDrawn = true;
    return own;
}

/// Lists a blade before which so many parts are listed in its list; whether there was room.
bool listOwn(OwnBlade own, uint before)
{
    if (!own.isHeavy)
        return putParts(own.ribbon, own.visible, mostHeavyParts + before, own.parts, own.segments);
    if (before + own.parts <= mostHeavyParts)
        return putParts(own.ribbon, own.visible, mostHeavyParts - before - own.parts, own.parts, own.segments);
    // There is nothing at the last places, and the blade comes to the others.
    for (uint slot = 0u; slot + before < mostHeavyParts; ++slot)
        putPart(push.large, slot, partOf(own.ribbon, own.visible.blade, 0u));
    WalkLevelArray asked = push.largeCount;
    const uint slot = atomicAdd(asked.at[largeParts].count, own.parts);
    noteListed(slot + own.parts, 0u);
    return putParts(own.ribbon, own.visible, mostHeavyParts + slot, own.parts, own.segments);
}

/// Finds room in the lists for what a group lists together: others, and heavy ones.
void findRoom(uint thread)
{
    if (thread >= 2u || listedParts[thread] == 0u)
        return;
    WalkLevelArray asked = push.largeCount;
    listBase[thread] = atomicAdd(asked.at[thread == 0u ? 0u : 5u].count, listedParts[thread]);
    const uint listed = listBase[thread] + listedParts[thread];
    if (thread == 1u)
        noteHeavy(listed);
    else
        noteListed(listed, push.round > 0u ? asked.at[largeEarly].groups[0] : 0u);
}

/// All threads come here together, each with a blade or with none. They have their places in the lists by
/// one atomic.
void rasterise(Lens lens, bool hasBlade, uint place)
{
    const uint thread = gl_LocalInvocationIndex;
    const bool areListed = largeTo != largeToNobody;
    if (areListed) {
        if (thread < 2u)
            listedParts[thread] = 0u;
        barrier();
    }
    OwnBlade own;
    own.isDrawn = false;
    own.isHeavy = false;
    own.parts = 0u;
    if (hasBlade)
        own = ownBlade(lens, FRAME.visible.at[place]);
    if (areListed) {
        const uint list = own.isHeavy ? 1u : 0u;
        uint before = 0u;
        if (own.parts > 0u)
            before = atomicAdd(listedParts[list], own.parts);
        barrier();
        findRoom(thread);
        barrier();
        if (own.parts > 0u && listOwn(own, listBase[list] + before))
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
