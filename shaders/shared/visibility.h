// The cull result of patches and blades in one view: the predicates of culling.h in their order.
#ifndef SWARD_SHARED_VISIBILITY_H
#define SWARD_SHARED_VISIBILITY_H

#include "shaders/shared/blade.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/ribbon.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// What becomes of a blade, and how it is drawn.
struct Verdict {
    uint cullResult;
    float widthFactor; ///< 0 unless drawn
    float pixels;      ///< height on the screen [pixels]
    vec3 v1;           ///< of the blade's curve; only where cullFrustum or cullOcclusion asks
    vec3 v2;
    float margin; ///< [m] by which the blade reaches beyond it
};

/// Share of the blades that is drawn at `distance` [m]: lodFullShare where none is left out or
/// fades, as everywhere without level of detail.
SHARED_FN float shareAt(Eyepoint view, float distance)
{
    if (view.lodThreshold <= 0.0f)
        return lodFullShare;
    return lodShare(view.lodWidth * view.pixelsPerUnit / max(distance, 1e-6f), view.lodThreshold);
}

/// Width of a patch's blades [m]: the middle of what its numbers reach.
SHARED_FN float middleWidth(Patch cell)
{
    return cell.widthLow + 31.5f * cell.widthStep;
}

/// m² of blade (one side) per m² of ground around a patch's blades; no more than there is where
/// they stand apart, at most maxLeafArea, and 0 where too few of them are its own to tell.
SHARED_FN float leafAreaAround(Patch cell)
{
    const uint fewest = 4u;
    if (cell.bladeCount < fewest)
        return 0.0f;
    const float count = float(cell.bladeCount);
    // So much wider than they span is the square that n places are scattered over, on average.
    const float side = 65535.0f * cell.rootStep * (count + 1.0f) / (count - 1.0f);
    const float around = count / max(cell.rankHigh - cell.rankLow, 1e-6f);
    const float height = cell.heightLow + 127.5f * cell.heightStep;
    // Outlines fill from a half to all of their rectangle.
    return min(0.7f * around * middleWidth(cell) * height / max(side * side, 1e-12f), maxLeafArea);
}

/// Largest cosine between the ground's normal around a patch and a ray from `eye` to it.
SHARED_FN float steepestRay(vec3 eye, Patch cell)
{
    const vec3 low = cell.boundsLow - eye;
    const vec3 high = cell.boundsHigh - eye;
    const vec3 middle = 0.5f * (low + high);
    const float above =
        abs(dot(cell.coneAxis, middle)) + dot(abs(cell.coneAxis), 0.5f * (high - low));
    const float nearest = max(boxDistance(eye, cell.boundsLow, cell.boundsHigh), 1e-6f);
    // That up-vectors are rounded makes no slope.
    const float slope = sqrt(max(1.0f - cell.coneCosine * cell.coneCosine, 0.0f));
    return min(above / nearest + max(slope - octahedralMaxError, 0.0f), 1.0f);
}

/// What is drawn of a patch of which grass hides a part by itself.
struct LeafAreaLimit {
    float share; ///< of its blades, see leafAreaShare(); lodFullShare: all
    float height; ///< so many times as high they stand, see heightCompensation()
    float light; ///< so much of the leaf area over them they are lit with, see leafAreaLight()
};

/// Of all blades as they are.
SHARED_FN LeafAreaLimit noLeafAreaLimit()
{
    LeafAreaLimit limit;
    limit.share = lodFullShare;
    limit.height = 1.0f;
    limit.light = 1.0f;
    return limit;
}

/// What is drawn of a patch where those behind are hidden.
SHARED_FN LeafAreaLimit leafAreaLimitOf(Eyepoint view, Patch cell)
{
    LeafAreaLimit limit = noLeafAreaLimit();
    if (view.maxLeafArea <= 0.0f)
        return limit;
    const float nearest = max(boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), 1e-6f);
    const float pixels = middleWidth(cell) * view.pixelsPerUnit / nearest;
    // Most of what one sees is so near that neither density nor steepness could leave any out.
    if (leafAreaShare(view.maxLeafArea, maxLeafArea, 0.0f, pixels) >= lodFullShare)
        return limit;
    const float leafArea = leafAreaAround(cell);
    const float cosine = steepestRay(view.eye, cell);
    limit.share = leafAreaShare(view.maxLeafArea, leafArea, cosine, pixels);
    const float range = 255.0f * cell.heightStep;
    const float spread = min(2.0f * range / max(cell.heightLow + range, 1e-6f), 1.0f);
    limit.height = heightCompensation(limit.share, leafAreaShare(1.0f, leafArea, cosine, 1.0f), spread);
    limit.light = leafAreaLight(limit.share, spread);
    return limit;
}

/// A blade as high as it stands where others are left out.
SHARED_FN Blade raised(Blade blade, float heightFactor)
{
    Blade drawn = blade;
    drawn.height = blade.height * heightFactor;
    return drawn;
}

/// How large a blade is drawn.
struct DrawnSize {
    float widthFactor; ///< 0: not at all
    float pixels;      ///< height on the screen [pixels]
};

/// `limit`: leafAreaLimitOf() its patch, by which `blade` is raised().
SHARED_FN DrawnSize drawnSize(Eyepoint view, LeafAreaLimit limit, Blade blade, float rank, float distance)
{
    // Where blades are drawn wider, so many fewer of them are a layer.
    const float share = shareAt(view, distance);
    DrawnSize size;
    size.widthFactor =
        lodWidthFactor(rank, share) * leafAreaWeight(rank / min(share, 1.0f), limit.share);
    size.pixels = blade.height * view.pixelsPerUnit / max(distance, 1e-6f);
    return size;
}

/// So many pixels a blade covers that is seen from its broad side, `height` [pixels] high.
SHARED_FN float pixelsCovered(Blade blade, float height, float widthFactor)
{
    return height * height * widthFactor * blade.width / blade.height;
}

/// Progressive rank in [0, 1) of blade `i` of a patch among all blades around it.
SHARED_FN float bladeRank(Patch cell, uint i)
{
    return mix(cell.rankLow, cell.rankHigh, (float(i) + 0.5f) / float(cell.bladeCount));
}

/// By how much blades drawn wider and higher than they are may stand out of a node's bounds [m],
/// none of them wider than `widest` [m].
SHARED_FN float patchMargin(Eyepoint view, Patch cell, float widest)
{
    const vec3 farthest = max(abs(cell.boundsLow - view.eye), abs(cell.boundsHigh - view.eye));
    const float share = shareAt(view, length(farthest));
    // No blade is higher than half its node's box, in which it may lie on any side of its root.
    const vec3 size = cell.boundsHigh - cell.boundsLow;
    const float highest = 0.5f * min(size.x, min(size.y, size.z));
    // lodWidthFactor() is at most 1/(0.95 share).
    return 0.5f * outlineMost * widest / (0.95f * share) +
           sectionMargin(length(farthest), view.minWidth) +
           (view.maxLeafArea > 0.0f ? (maxHeightCompensation - 1.0f) * highest : 0.0f);
}

/// How many of the patch's blades, the first so many, level of detail may draw from this eyepoint:
/// those behind them have no width wherever in its box they stand. All of them unless the eyepoint
/// says that thinned blades are left alone.
SHARED_FN uint thickEnough(Eyepoint view, Patch cell)
{
    if ((view.cullMask & leaveThinned) == 0u || view.lodThreshold <= 0.0f)
        return cell.bladeCount;
    const float thinned = shareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh));
    const float share = min(thinned, min(thinned, 1.0f) * leafAreaLimitOf(view, cell).share);
    if (share <= cell.rankLow)
        return 0u;
    if (share >= cell.rankHigh)
        return cell.bladeCount;
    // One more than bladeRank() says, for the rounding of both.
    const float count = float(cell.bladeCount);
    const float first = (share - cell.rankLow) / (cell.rankHigh - cell.rankLow) * count;
    return min(uint(ceil(first)) + 1u, cell.bladeCount);
}

/// Whether level of detail draws none of the blades below a node, the first of which has the rank
/// `rankBelow`: they have no width wherever in its box they stand. Never unless the eyepoint says
/// that thinned blades are left alone.
SHARED_FN bool thinnedBelow(Eyepoint view, Patch cell, float rankBelow)
{
    return (view.cullMask & leaveThinned) != 0u && view.lodThreshold > 0.0f &&
           shareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh)) <= rankBelow;
}

/// Whether no blade of a node and of those below can be seen: its box, grown by half the width that
/// the widest of them can be drawn with, lies outside a plane, or beyond the draw distance where
/// that counts. `widest` is Subtree::widest. What is below a node that is culled would be, too.
SHARED_FN bool patchCulled(Eyepoint view, Patch cell, float widest)
{
    if ((view.cullMask & cullPatch) == 0u)
        return false;

    const float margin = patchMargin(view, cell, widest);
    const vec3 low = cell.boundsLow - vec3(margin);
    const vec3 high = cell.boundsHigh + vec3(margin);
    bool outside = false;
    SHARED_UNROLL for (uint i = 0u; i < 6u; ++i) outside =
        outside || boxOutside(view.planes[i], low, high);
    if (outside)
        return true;
    return (view.cullMask & cullDistance) != 0u &&
           boxDistance(view.eye, cell.boundsLow, cell.boundsHigh) > view.drawDistance;
}

/// Whether a blade is seen so narrow that no sample is left to it wherever it is drawn, so that it
/// may be left out of a picture without a trace; or beyond the cosine that somebody has set.
SHARED_FN bool seenTooNarrow(Eyepoint view, Blade blade, uint index, vec3 axis, float distance,
                             float widthFactor)
{
    const float cosine = edgeOnCosine(view.eye, blade.root, axis);
    if (cosine > view.maxEdgeOn)
        return true;
    const float nearest = distance - blade.height;
    if (nearest <= 0.0f || view.minWidth <= 0.0f)
        return false;
    // All of the blade is within its height of its root, so rays to it turn by no more than
    // asin(height/distance) ≤ π/2 · height/distance.
    const float sine = min(sqrt(1.0f - cosine * cosine) + 1.58f * blade.height / distance, 1.0f);
    const float widest = outlineMost * blade.width * widthFactor * sine;
    return keptSamples(widest / (view.minWidth * nearest), index, view.samples) == 0u;
}

/// The cull result of one blade of a patch that was not culled, in the order orientation, frustum,
/// distance, level of detail. `limit`: leafAreaLimitOf() its patch, by which `blade` is raised(). `index`
/// is its resident id.
SHARED_FN Verdict cullBlade(Eyepoint view, LeafAreaLimit limit, Blade blade, uint index,
                             BladeState state, float rank)
{
    const vec3 axis = widthAxis(blade.up, blade.facing);
    const float distance = length(blade.root - view.eye);
    const DrawnSize size = drawnSize(view, limit, blade, rank, distance);
    const float factor = size.widthFactor;

    Verdict verdict;
    verdict.cullResult = cullResultDrawn;
    verdict.widthFactor = factor;
    verdict.pixels = size.pixels;

    bool outside = false;
    verdict.v1 = blade.root;
    verdict.v2 = blade.root;
    verdict.margin = 0.0f;
    if ((view.cullMask & (cullFrustum | cullOcclusion)) != 0u) {
        const Pose pose = poseOfState(axesAlong(blade.up, axis), state);
        const vec3 v1 = blade.root + blade.height * pose.v1;
        const vec3 v2 = blade.root + blade.height * pose.v2;
        const float margin = 0.5f * outlineMost * blade.width * max(factor, 1.0f) +
                             sectionMargin(distance + blade.height, view.minWidth);
        verdict.v1 = v1;
        verdict.v2 = v2;
        verdict.margin = margin;
        if ((view.cullMask & cullFrustum) != 0u)
            SHARED_UNROLL for (uint i = 0u; i < 6u; ++i) outside =
                outside || curveOutside(view.planes[i], blade.root, v1, v2, margin);
    }

    if ((view.cullMask & cullOrientation) != 0u &&
        seenTooNarrow(view, blade, index, axis, distance, factor > 0.0f ? factor : 1.0f))
        verdict.cullResult = cullResultOrientation;
    else if (outside)
        verdict.cullResult = cullResultFrustum;
    else if ((view.cullMask & cullDistance) != 0u &&
             (distance > view.drawDistance ||
              !bucketsKeep(view.buckets, view.bucketDistance, distance, rank)))
        verdict.cullResult = cullResultDistance;
    else if (factor <= 0.0f)
        verdict.cullResult = cullResultLod;
    if (verdict.cullResult != cullResultDrawn)
        verdict.widthFactor = 0.0f;
    return verdict;
}

SHARED_END
#endif
