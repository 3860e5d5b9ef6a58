#version 460
#extension GL_GOOGLE_include_directive : require
// Draws the blades near the eye into a BladeShadow, as the sun sees them. A work-group takes a part of a patch that the
// walk of the sun's view has found; a thread poses a blade, then draws segments. Blades have the widths that the eye's
// level of detail gives them.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { BladeShadowPush push; };

// Whether only some blades may be in memory; known at pipeline creation.
layout(constant_id = idIsPaged) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/raster/span.glsl"

layout(local_size_x = bladeShadowThreads) in;

// The blades that the group draws together, in shared memory.
shared Ribbon ribbons[bladeShadowThreads];
shared uint ribbonCount;

/// Puts blade `i` of a patch among the ribbons, unless the map does not show it.
void putRibbon(Eyepoint view, uint patchIndex, Patch cell, LeafAreaLimit limit, uint i)
{
    const uint index = cell.firstBlade + i;
    const uint place = placeOf(uvec2(FRAME.pages), index);
    const PackedBlade bits = FRAME.blades.at[place];
    uint turn = FRAME.states.at[place];
    // No view has shown this blade yet: it stands as baked.
    turn = turn == unsettledTurn ? 0u : turn;
    const PosedLook part = posedLook(raised(unpackBlade(bits, cell), limit.height), BladeState(turn, 0.0));
    const DrawnSize size = drawnSize(view, limit, part.posed.blade, bladeRank(cell, i - min(part.number, i)),
                                     length(part.posed.blade.root - view.eye));
    if (size.widthFactor <= 0.0)
        return;
    const float margin = 0.5 * outlineMost * part.posed.blade.width * size.widthFactor;
    bool outside = false;
    SHARED_UNROLL for (uint side = 0u; side < 4u; ++side)
        outside = outside || curveOutside(view.planes[side], part.posed.v0, part.posed.v1, part.posed.v2, margin);
    if (outside)
        return;
    const VisibleBlade visible =
        VisibleBlade(index, patchIndex, packFactors(size.widthFactor, limit.height), size.pixels);
    Ribbon ribbon = drawnBlade(visible, part).ribbon;
    ribbon.fold = 0.0;
    ribbon.outline = outlineOf(ribbon.outline.shape, ribbon.outline.tipThreshold, float(bladeShadowSegments));
    ribbons[atomicAdd(ribbonCount, 1u)] = ribbon;
}

/// Draws a segment of a ribbon.
void drawSegment(Lens lens, Ribbon ribbon, uint segment)
{
    const float each = 1.0 / float(bladeShadowSegments);
    const ScreenSection before = screenSection(seenSection(lens, ribbon, float(segment) * each), false);
    const ScreenSection after = screenSection(seenSection(lens, ribbon, float(segment + 1u) * each), false);
    const SampleMask mask = sampleMaskOf(ribbon.seed, 1u);
    const Quad whole = halfOf(0u, before, after, false);
    const bool isTwisted = !isConvex(whole);
    for (uint part = 0u; part < (isTwisted ? 2u : 1u); ++part)
        drawSmall(isTwisted ? triangleBetween(part, before, after, false, 2u * segment >= bladeShadowSegments) : whole,
                  mask, ribbon.seed);
}

void main()
{
    const Lens lens = lensOf();
    const Eyepoint view = FRAME.view;
    const uint thread = gl_LocalInvocationIndex;
    WalkLevelArray levels = push.levels;
    const uint count = levels.at[visibleLevel].count;
    const uint chunks = maxPatchBlades / bladeShadowThreads;
    for (uint task = gl_WorkGroupID.x; task < count * chunks; task += gl_NumWorkGroups.x) {
        const VisiblePatch visible = push.visiblePatches.at[task / chunks];
        const uint first = task % chunks * bladeShadowThreads;
        if (first >= visible.count)
            continue;
        const Patch cell = FRAME.patches.at[visible.patchIndex];
        const LeafAreaLimit limit = leafAreaLimitOf(view, cell);
        barrier();
        if (thread == 0u)
            ribbonCount = 0u;
        barrier();
        if (first + thread < visible.count)
            putRibbon(view, visible.patchIndex, cell, limit, first + thread);
        barrier();
        // Each segment by a thread of its own: no thread waits for a long blade.
        for (uint item = thread; item < ribbonCount * bladeShadowSegments; item += bladeShadowThreads)
            drawSegment(lens, ribbons[item / bladeShadowSegments], item % bladeShadowSegments);
    }
}
