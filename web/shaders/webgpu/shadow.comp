// Draws the blades near the eye into the map of their shadows, as the sun sees them: raster_shadow.comp of the viewer. A
// work-group takes a patch that the walk of the sun's view has found.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/shared/patch_tree.h"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/raster/span.glsl"

layout(local_size_x = 64) in;

void drawBlade(Lens lens, uint patchIndex, Patch cell, LeafAreaLimit limit, uint i)
{
    const uint index = cell.firstBlade + i;
    uint turn = states[index];
    // No view has shown this blade yet: it stands as baked.
    turn = turn == unsettledTurn ? 0u : turn;
    const PosedLook part = posedLook(raised(unpackBlade(blades[index], cell), limit.height), BladeState(turn, 0.0));
    const DrawnSize size = drawnSize(FRAME.view, limit, part.posed.blade, bladeRank(cell, i - min(part.number, i)),
                                     length(part.posed.blade.root - FRAME.view.eye));
    if (size.widthFactor <= 0.0)
        return;
    const float margin = 0.5 * outlineMost * part.posed.blade.width * size.widthFactor;
    bool outside = false;
    for (uint side = 0u; side < 4u; ++side)
        outside = outside ||
                  curveOutside(FRAME.view.planes[side], part.posed.v0, part.posed.v1, part.posed.v2, margin);
    if (outside)
        return;
    const VisibleBlade blade =
        VisibleBlade(index, patchIndex, packFactors(size.widthFactor, limit.height), size.pixels);
    Ribbon ribbon = drawnBlade(blade, part).ribbon;
    ribbon.fold = 0.0;
    ribbon.outline = outlineOf(ribbon.outline.shape, ribbon.outline.tipThreshold, float(bladeShadowSegments));
    const float each = 1.0 / float(bladeShadowSegments);
    const SampleMask mask = sampleMaskOf(ribbon.seed, 1u);
    ScreenSection before = screenSection(seenSection(lens, ribbon, 0.0), false);
    for (uint segment = 0u; segment < bladeShadowSegments; ++segment) {
        const ScreenSection after = screenSection(seenSection(lens, ribbon, float(segment + 1u) * each), false);
        const Quad whole = halfOf(0u, before, after, false);
        const bool isTwisted = !isConvex(whole);
        for (uint half_ = 0u; half_ < (isTwisted ? 2u : 1u); ++half_) {
            Quad quad = whole;
            if (isTwisted)
                quad = triangleBetween(half_, before, after, false, 2u * segment >= bladeShadowSegments);
            drawSmall(quad, mask, ribbon.seed);
        }
        before = after;
    }
}

void main()
{
    const uint place = gl_WorkGroupID.y * groupsOfRow + gl_WorkGroupID.x;
    if (place >= arguments[argumentsPatches + 3u])
        return;
    const VisiblePatch item = visiblePatches[place];
    const Patch cell = patches[item.patchIndex];
    const LeafAreaLimit limit = leafAreaLimitOf(FRAME.view, cell);
    const Lens lens = lensOf();
    for (uint i = gl_LocalInvocationIndex; i < item.count; i += 64u)
        drawBlade(lens, item.patchIndex, cell, limit, i);
}
