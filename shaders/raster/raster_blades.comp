#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each, but for those of the late turn. Those that cover many pixels are left to
// raster_large.comp, to the tessellator, or, on a CPU, if they are very many, to raster_cut.comp, as are
// those that reach through the near plane.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#include "shaders/raster/draw_alone.glsl"

layout(local_size_x = rasterThreads) in;

// Whose affair large blades are; known when the pipeline is made.
layout(constant_id = 4) const uint largeTo = largeToGroups;
const bool isTessellated = largeTo == largeToTessellator;
const bool isLate = false;

#include "shaders/raster/large_list.glsl"

/// Gives a blade that covers so many pixels to work-groups or the tessellator; whether there was room.
bool leftToOthers(Ribbon ribbon, VisibleBlade visible, float pixels)
{
    WalkLevelArray asked = push.largeCount;
    const uint parts = partsFor(pixels);
    const uint slot = atomicAdd(asked.at[0].count, parts);
    // Those of other rounds than the first are all listed after the first turn.
    const uint late = push.round > 0u          ? 0u
                      : push.takesTurns != 0u ? lateQuartersUnseen(pixels, visible.blade)
                                              : visible.factors >> lateShift;
    const bool hasRoom = putParts(ribbon, visible, slot, parts,
                                  firstSegments(late, uint(ribbon.outline.segments)));
    noteListed(slot + parts);
    return hasRoom;
}

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

void rasterise(Lens lens, VisibleBlade visible)
{
    const Blade blade = visibleBlade(visible);
    if (listsThoseBeside() && isFarBeside(lens, visible, blade))
        return;
    const DrawnBlade drawn = drawnBlade(visible, blade);
    const Ribbon ribbon = drawn.ribbon;
    const float margin =
        marginBeside(ribbon.width, length(ribbon.v0 - lens.eye) + blade.height, lens.leastWidth);
    if (listsThoseBeside() && isBeside(ribbon, margin))
        return;
    const float pixels = pixelsOf(lens, visible, ribbon, blade.height);
    const bool mayBeCut =
        !curveInside(FRAME.view.planes[4], ribbon.v0, ribbon.v1, ribbon.v2, margin);
    if (mayBeCut && !isTessellated) {
        leftToBeCut(ribbon, visible.blade);
        return;
    }
    // A thread takes twice as long for a pixel of four samples as for one of one; a tessellator does not.
    const float most =
        isTessellated ? tessellatedPixels : largeBladePixels * inversesqrt(float(samplesPerPixel));
    if (largeTo != largeToNobody && (mayBeCut || pixels > most) &&
        leftToOthers(ribbon, visible, pixels))
        return;
    if (largeTo == largeToNobody && pixelsAtMost(lens, ribbon, blade.height) > mostPixelsOfThread &&
        leftToBeCut(ribbon, visible.blade))
        return;
    // The tessellator had no room.
    if (mayBeCut)
        return;

    drawAlone(lens, ribbon, visible.blade);
}

void main()
{
    const uint capacity = FRAME.visibleCapacity;
    const uint count = min(push.rounds.at[push.round].count, capacity);
    const Lens lens = lensOf();
    for (uint place = gl_GlobalInvocationID.x; place < count;
         place += gl_NumWorkGroups.x * rasterThreads)
        rasterise(lens, FRAME.visible.at[place]);
}
