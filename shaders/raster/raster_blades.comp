#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each. Those that cover many pixels, or reach through the
// near plane, are left to raster_large.comp.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/strip.glsl"

layout(local_size_x = rasterThreads) in;

// Whether the blades of the list's end are taken, which all cover many pixels; known when the
// pipeline is made.
layout(constant_id = 2) const bool isLate = false;

// Whether large blades are the tessellator's affair; known when the pipeline is made.
layout(constant_id = 4) const bool isTessellated = false;

/// Gives a blade that covers so many pixels to work-groups or the tessellator; whether there was room.
bool leftToOthers(Ribbon ribbon, uint blade, float pixels)
{
    WalkLevelArray asked = push.largeCount;
    LargePartArray large = push.large;
    const uint parts = isTessellated ? 1u : clamp(uint(pixels / partPixels), 1u, mostParts);
    const uint slot = atomicAdd(asked.at[0].count, parts);
    const bool hasRoom = slot + parts <= mostLargeParts;
    for (uint part = 0u; part < parts && slot + part < mostLargeParts; ++part)
        large.at[slot + part] =
            LargePart(ribbon.v0, ribbon.width, ribbon.v1, ribbon.fold, ribbon.v2,
                      ribbon.outline.segments, ribbon.axis, ribbon.outline.tipThreshold,
                      ribbon.outline.scale, ribbon.outline.shape, blade,
                      hasRoom ? part | (parts << 16u) : 0u);
    const uint listed = min(slot + parts, mostLargeParts);
    if (isTessellated)
        atomicMax(asked.at[1].groups[1], (listed + drawChunk - 1u) / drawChunk);
    else
        atomicMax(asked.at[0].groups[0], min(listed, mostGroups));
    return hasRoom;
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
    const float reach = blade.height + 0.5 * outlineMost * blade.width * widthFactorOf(visible) +
                        ribMargin(length(blade.root - lens.eye) + blade.height, lens.leastWidth);
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || planeDistance(FRAME.view.planes[i], blade.root) < -reach;
    return beside;
}

/// Whether a blade lies beside the picture.
bool isBeside(Lens lens, Ribbon ribbon, float height)
{
    const float margin = 0.5 * outlineMost * ribbon.width +
                         ribMargin(length(ribbon.v0 - lens.eye) + height, lens.leastWidth);
    bool beside = false;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i) beside =
        beside || curveOutside(FRAME.view.planes[i], ribbon.v0, ribbon.v1, ribbon.v2, margin);
    return beside;
}

/// A rib on the screen, if it is not cut by the near plane.
struct SmallRib {
    ScreenRib rib;
    bool isCut;
    bool isLost;
};

SmallRib smallRib(Lens lens, Ribbon ribbon, float t)
{
    const SeenRib seen = seenRib(lens, ribbon, t);
    return SmallRib(screenRib(seen, ribbon.fold > 0.0), isCut(seen), isLost(seen));
}

void rasterise(Lens lens, VisibleBlade visible)
{
    const Blade blade = visibleBlade(visible);
    if (listsThoseBeside() && isFarBeside(lens, visible, blade))
        return;
    const DrawnBlade drawn = drawnBlade(visible, blade);
    const Ribbon ribbon = drawn.ribbon;
    if (listsThoseBeside() && isBeside(lens, ribbon, blade.height))
        return;
    const float widthPixels = max(visible.pixels * ribbon.width / drawn.blade.height,
                                  lens.leastWidth * FRAME.view.pixelsPerUnit);
    const float pixels = visible.pixels * widthPixels;
    // A thread takes twice as long for a pixel of four samples as for one of one; a tessellator does not.
    const float most =
        isTessellated ? largeBladePixels : largeBladePixels * inversesqrt(float(samplesPerPixel));
    if ((isLate || pixels > most) && leftToOthers(ribbon, visible.blade, pixels))
        return;

    const bool isFolded = ribbon.fold > 0.0;
    const float segments = ribbon.outline.segments;
    const SampleMask mask = sampleMaskOf(visible.blade, samplesPerPixel);
    SmallRib before = smallRib(lens, ribbon, 0.0);
    float segment = 1.0;
    uint part = 0u;
    // Part by part: of a segment mostly one. While one is drawn no more than one rib is kept.
    while (segment <= segments) {
        const SmallRib after = smallRib(lens, ribbon, segment / segments);
        if (before.isCut || after.isCut) {
            // What this thread has drawn already will be drawn again, the same.
            if (!before.isLost || !after.isLost) {
                leftToOthers(ribbon, visible.blade, pixels);
                return;
            }
            before = after;
            segment += 1.0;
            continue;
        }
        bool isTwisted = false;
        for (uint i = 0u; i < halvesOf(isFolded); ++i)
            isTwisted = isTwisted || !isConvex(halfOf(i, before.rib, after.rib, isFolded));
        const Quad quad = isTwisted ? triangleBetween(part, before.rib, after.rib, isFolded,
                                                      upperHalf(segment, segments))
                                    : halfOf(part, before.rib, after.rib, isFolded);
        ++part;
        if (part >= (isTwisted ? trianglesOf(isFolded) : halvesOf(isFolded))) {
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
