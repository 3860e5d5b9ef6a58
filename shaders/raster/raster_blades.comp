#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each. Those that cover many pixels are left to
// raster_large.comp, to the tessellator, or, on a CPU, if they are very many, to raster_cut.comp, as are
// those that reach through the near plane.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/strip.glsl"

layout(local_size_x = rasterThreads) in;

// Whether the blades of the list's end are taken, which all cover many pixels; known when the
// pipeline is made.
layout(constant_id = 2) const bool isLate = false;

// Whose affair large blades are; known when the pipeline is made.
layout(constant_id = 4) const uint largeTo = largeToGroups;
const bool isTessellated = largeTo == largeToTessellator;

/// A blade, or a part of it, as it is listed. `part`: LargePart::part.
LargePart partOf(Ribbon ribbon, uint blade, uint part)
{
    return LargePart(ribbon.v0, ribbon.width, ribbon.v1, ribbon.fold, ribbon.v2, ribbon.outline.segments,
                     ribbon.axis, ribbon.outline.tipThreshold, ribbon.outline.scale,
                     ribbon.outline.shape, blade, part);
}

/// Gives a blade that covers so many pixels to work-groups or the tessellator; whether there was room.
bool leftToOthers(Ribbon ribbon, VisibleBlade visible, float pixels)
{
    WalkLevelArray asked = push.largeCount;
    const uint parts = isTessellated ? 1u : clamp(uint(pixels / partPixels), 1u, mostParts);
    const uint slot = atomicAdd(asked.at[0].count, parts);
    const bool hasRoom = slot + parts <= mostLargeParts;
    uint late = ((visible.factors & lowerHalfIsLate) != 0u ? lowerPartIsLate : 0u) |
                ((visible.factors & upperHalfIsLate) != 0u ? upperPartIsLate : 0u);
    if (push.takesTurns != 0u)
        late = latePartsUnseen(pixels, visible.blade);
    for (uint part = 0u; part < parts && slot + part < mostLargeParts; ++part)
        putPart(push.large, slot + part,
                partOf(ribbon, visible.blade, hasRoom ? part | (parts << 16u) | late : 0u));
    const uint listed = min(slot + parts, mostLargeParts);
    if (isTessellated)
        atomicMax(asked.at[1].groups[1], (listed + drawChunk - 1u) / drawChunk);
    else
        atomicMax(asked.at[0].groups[0], groupsForLarge(listed, isLate));
    return hasRoom;
}

/// Gives a blade that may reach through the near plane to those who cut it there; whether there was room.
bool leftToBeCut(Ribbon ribbon, uint blade)
{
    WalkLevelArray asked = push.largeCount;
    const uint slot = atomicAdd(asked.at[3].count, 1u);
    if (slot >= mostCutBlades)
        return false;
    putPart(push.cut, slot, partOf(ribbon, blade, 1u << 16u));
    atomicMax(asked.at[3].groups[0], min(slot + 1u, mostGroups));
    return true;
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

/// Whether the list holds blades beside the picture.
bool listsThoseBeside()
{
    return uvec2(push.frame) != uvec2(push.judged) || (FRAME.view.cullMask & cullFrustum) == 0u;
}

/// Whether a blade lies beside the picture whichever way it bends: most of those that do, and known
/// of one that has not been posed yet.
bool isFarBeside(Lens lens, VisibleBlade visible, Blade blade)
{
    const float reach =
        blade.height + marginBeside(blade.width * widthFactorOf(visible),
                                    length(blade.root - lens.eye) + blade.height, lens.leastWidth);
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || planeDistance(FRAME.view.planes[i], blade.root) < -reach;
    return beside;
}

/// Whether a blade lies beside the picture.
bool isBeside(Ribbon ribbon, float margin)
{
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || curveOutside(FRAME.view.planes[i], ribbon.v0, ribbon.v1, ribbon.v2, margin);
    return beside;
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
    const float widthPixels = max(visible.pixels * ribbon.width / drawn.blade.height,
                                  lens.leastWidth * FRAME.view.pixelsPerUnit);
    const float pixels = visible.pixels * widthPixels;
    const bool mayBeCut =
        !curveInside(FRAME.view.planes[4], ribbon.v0, ribbon.v1, ribbon.v2, margin);
    if (mayBeCut && !isTessellated) {
        leftToBeCut(ribbon, visible.blade);
        return;
    }
    // A thread takes twice as long for a pixel of four samples as for one of one; a tessellator does not.
    const float most =
        isTessellated ? tessellatedPixels : largeBladePixels * inversesqrt(float(samplesPerPixel));
    if (largeTo != largeToNobody && (isLate || mayBeCut || pixels > most) &&
        leftToOthers(ribbon, visible, pixels))
        return;
    if (largeTo == largeToNobody && pixelsAtMost(lens, ribbon, blade.height) > mostPixelsOfThread &&
        leftToBeCut(ribbon, visible.blade))
        return;
    // The tessellator had no room.
    if (mayBeCut)
        return;

    const bool hasRidge = isFolded(ribbon);
    const float segments = ribbon.outline.segments;
    const SampleMask mask = sampleMaskOf(visible.blade, samplesPerPixel);
    ScreenRib before = screenRib(seenRib(lens, ribbon, 0.0), hasRidge);
    float segment = 1.0;
    uint part = 0u;
    // Part by part: of a segment mostly one. While one is drawn no more than one rib is kept.
    while (segment <= segments) {
        const ScreenRib after = screenRib(seenRib(lens, ribbon, segment / segments), hasRidge);
        bool isTwisted = false;
        for (uint i = 0u; i < halvesOf(hasRidge); ++i)
            isTwisted = isTwisted || !isConvex(halfOf(i, before, after, hasRidge));
        const Quad quad = isTwisted ? triangleBetween(part, before, after, hasRidge, upperHalf(segment, segments))
                                    : halfOf(part, before, after, hasRidge);
        ++part;
        if (part >= (isTwisted ? trianglesOf(hasRidge) : halvesOf(hasRidge))) {
            before = after;
            segment += 1.0;
            part = 0u;
        }
        drawSmall(quad, mask, visible.blade);
    }
}

void main()
{
    const uint capacity = FRAME.visibleCapacity;
    const uint count = min(push.rounds.at[push.round].count, capacity);
    const Lens lens = lensOf();
    for (uint place = gl_GlobalInvocationID.x; place < count;
         place += gl_NumWorkGroups.x * rasterThreads)
        rasterise(lens, FRAME.visible.at[isLate ? capacity - 1u - place : place]);
}
