// The cull result of patches and blades in one view: the predicates of culling.h in order.
#ifndef SWARD_SHARED_VISIBILITY_H
#define SWARD_SHARED_VISIBILITY_H

#include "shaders/shared/blade.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/ribbon.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// The cull result of a blade, and its drawn size.
struct Verdict {
    uint cullResult;
    float widthFactor; ///< 0 unless drawn
    float pixels;      ///< height on the screen [pixels]
    float margin;      ///< [m] maximum distance of the blade from its curve
};

/// Factor on the `share` that level of detail draws at `distance` [m], for a field that is sown as
/// far as memory allows (decision 0045): it falls with the distance to the power of 1.5 beyond
/// Eyepoint::sparseFrom, but what is stored is drawn everywhere. Drawn blades are widened for the
/// root of it only; the ground stands for the other leaves, see leavesPerDrawn().
SHARED_FN float sparseShare(Eyepoint view, float share, float distance)
{
    if (view.sparseFrom <= 0.0f || distance <= view.sparseFrom)
        return 1.0f;
    const float nearness = view.sparseFrom / distance;
    return max(nearness * nearness * nearness, min(view.sparseLeast / share, 1.0f));
}

/// Leaf area of the meadow relative to that of the drawn blades at `distance` [m], of a sown field:
/// 1 up to Eyepoint::sparseFrom.
SHARED_FN float leavesPerDrawn(Eyepoint view, float distance)
{
    if (view.sparseFrom <= 0.0f || distance <= view.sparseFrom || view.lodThreshold <= 0.0f)
        return 1.0f;
    const float share =
        lodShare(view.lodWidth * view.pixelsPerUnit / max(distance, 1e-6f), view.lodThreshold);
    return 1.0f / sqrt(sparseShare(view, share, distance));
}

/// Share of the blades that is drawn at `distance` [m]: lodFullShare if none is left out or fades,
/// and always without level of detail.
SHARED_FN float shareAt(Eyepoint view, float distance)
{
    if (view.lodThreshold <= 0.0f)
        return lodFullShare;
    const float share =
        lodShare(view.lodWidth * view.pixelsPerUnit / max(distance, 1e-6f), view.lodThreshold);
    return share * sparseShare(view, share, distance);
}

/// Width of a patch's blades [m]: the middle of its range.
SHARED_FN float middleWidth(Patch cell)
{
    return cell.widthLow + 31.5f * cell.widthStep;
}

/// m² of blade (one side) per m² of ground around a patch's blades. A lower bound for scattered
/// blades, at most maxLeafArea, and 0 for patches with too few own blades.
SHARED_FN float leafAreaAround(Patch cell)
{
    const uint fewest = 4u;
    if (cell.bladeCount < fewest)
        return 0.0f;
    const float count = float(cell.bladeCount);
    // Expected ratio of a square's width to the span of n places scattered in it.
    const float side = 65535.0f * cell.rootStep * (count + 1.0f) / (count - 1.0f);
    const float around = count / max(cell.rankHigh - cell.rankLow, 1e-6f);
    const float height = cell.heightLow + 127.5f * cell.heightStep;
    // Outlines fill half to all of their rectangle.
    return min(0.7f * around * middleWidth(cell) * height / max(side * side, 1e-12f), maxLeafArea);
}

/// Maximum cosine between the ground's normal around a patch and a ray from `eye` to it.
SHARED_FN float steepestRay(vec3 eye, Patch cell)
{
    const vec3 low = cell.boundsLow - eye;
    const vec3 high = cell.boundsHigh - eye;
    const vec3 middle = 0.5f * (low + high);
    const float above =
        abs(dot(cell.coneAxis, middle)) + dot(abs(cell.coneAxis), 0.5f * (high - low));
    const float nearest = max(boxDistance(eye, cell.boundsLow, cell.boundsHigh), 1e-6f);
    // Rounding of up-vectors does not count as slope.
    const float slope = sqrt(max(1.0f - cell.coneCosine * cell.coneCosine, 0.0f));
    return min(above / nearest + max(slope - octahedralMaxError, 0.0f), 1.0f);
}

/// The leaf-area limit of a patch, part of whose grass the patch's own grass hides.
struct LeafAreaLimit {
    float share;  ///< drawn share of its blades, see leafAreaShare(); lodFullShare: all
    float height; ///< height compensation factor, see heightCompensation()
    float light;  ///< factor on the leaf area above the blades for lighting, see leafAreaLight()
};

/// No limit: all blades, unchanged.
SHARED_FN LeafAreaLimit noLeafAreaLimit()
{
    LeafAreaLimit limit;
    limit.share = lodFullShare;
    limit.height = 1.0f;
    limit.light = 1.0f;
    return limit;
}

/// The leaf-area limit of a patch in a view.
SHARED_FN LeafAreaLimit leafAreaLimitOf(Eyepoint view, Patch cell)
{
    LeafAreaLimit limit = noLeafAreaLimit();
    if (view.maxLeafArea <= 0.0f)
        return limit;
    const float nearest = max(boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), 1e-6f);
    const float pixels = middleWidth(cell) * view.pixelsPerUnit / nearest;
    // Most visible patches are too near for a limit at any density or steepness.
    if (leafAreaShare(view.maxLeafArea, maxLeafArea, 0.0f, pixels) >= lodFullShare)
        return limit;
    const float leafArea = min(view.areaFactor * leafAreaAround(cell), maxLeafArea);
    const float cosine = steepestRay(view.eye, cell);
    limit.share = leafAreaShare(view.maxLeafArea, leafArea, cosine, pixels);
    const float range = 255.0f * cell.heightStep;
    const float spread = min(2.0f * range / max(cell.heightLow + range, 1e-6f), 1.0f);
    limit.height =
        heightCompensation(limit.share, leafAreaShare(1.0f, leafArea, cosine, 1.0f), spread);
    limit.light = leafAreaLight(limit.share, spread);
    return limit;
}

/// A blade with height compensation.
SHARED_FN Blade raised(Blade blade, float heightFactor)
{
    Blade drawn = blade;
    drawn.height = blade.height * heightFactor;
    return drawn;
}

/// The drawn size of a blade.
struct DrawnSize {
    float widthFactor; ///< 0: not drawn
    float pixels;      ///< height on the screen [pixels]
};

/// `limit`: leafAreaLimitOf() the patch; `blade` is raised() by it.
SHARED_FN DrawnSize drawnSize(Eyepoint view, LeafAreaLimit limit, Blade blade, float rank,
                              float distance)
{
    // Widened blades reach a layer's area with fewer blades, in proportion.
    const float share = shareAt(view, distance);
    DrawnSize size;
    size.widthFactor = lodWidthFactor(rank, share) / leavesPerDrawn(view, distance) *
                       leafAreaWeight(rank / min(share, 1.0f), limit.share);
    size.pixels = blade.height * view.pixelsPerUnit / max(distance, 1e-6f);
    return size;
}

/// Pixels that a blade of `height` [pixels] covers, seen from its broad side.
SHARED_FN float pixelsCovered(Blade blade, float height, float widthFactor)
{
    return height * height * widthFactor * blade.width / blade.height;
}

/// Progressive rank in [0, 1) of blade `i` of a patch among all surrounding blades.
SHARED_FN float bladeRank(Patch cell, uint i)
{
    return mix(cell.rankLow, cell.rankHigh, (float(i) + 0.5f) / float(cell.bladeCount));
}

/// Maximum distance [m] that widened and raised blades reach beyond a node's bounds; `widest` [m]
/// is the maximum width of its blades.
SHARED_FN float patchMargin(Eyepoint view, Patch cell, float widest)
{
    const vec3 farthest = max(abs(cell.boundsLow - view.eye), abs(cell.boundsHigh - view.eye));
    const float share = shareAt(view, length(farthest));
    // A blade is at most half as high as its node's box, in which it may lie in any direction.
    const vec3 size = cell.boundsHigh - cell.boundsLow;
    const float highest = 0.5f * min(size.x, min(size.y, size.z));
    // lodWidthFactor() is at most 1/(0.95 share).
    return 0.5f * outlineMost * widest / (0.95f * share * leavesPerDrawn(view, length(farthest))) +
           sectionMargin(length(farthest), view.minWidth) +
           (view.maxLeafArea > 0.0f ? (maxHeightCompensation - 1.0f) * highest : 0.0f);
}

/// Number of the patch's blades, from the first, that level of detail may draw from this eyepoint:
/// the blades after these have no width at any place in its box. All blades unless the eyepoint
/// leaves thinned blades alone.
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
    // One more than bladeRank() gives, for the rounding of both.
    const float count = float(cell.bladeCount);
    const float first = (share - cell.rankLow) / (cell.rankHigh - cell.rankLow) * count;
    return min(uint(ceil(first)) + 1u, cell.bladeCount);
}

/// Whether level of detail draws none of the blades below a node: they have no width at any place
/// in its box. `rankBelow`: rank of the first of them. Always false unless the eyepoint leaves
/// thinned blades alone.
SHARED_FN bool thinnedBelow(Eyepoint view, Patch cell, float rankBelow)
{
    return (view.cullMask & leaveThinned) != 0u && view.lodThreshold > 0.0f &&
           shareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh)) <= rankBelow;
}

/// Whether all blades of a node and its subtree are invisible: its box, grown by half the maximum
/// drawn width, lies outside a plane, or beyond the draw distance if that is tested. `widest` is
/// Subtree::widest. Nodes below a culled node would be culled, too.
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

/// Whether a blade is so narrow in the view that it keeps no sample wherever it is drawn, so that
/// culling does not change the picture; or whether it exceeds the set cosine.
SHARED_FN bool seenTooNarrow(Eyepoint view, PosedBlade posed, float widthFactor)
{
    const Blade blade = posed.blade;
    const float distance = length(posed.v0 - view.eye);
    const float cosine = edgeOnCosine(view.eye, posed.v0, posed.axis);
    if (cosine > view.maxEdgeOn)
        return true;
    const float nearest = distance - blade.height;
    if (nearest <= 0.0f || view.minWidth <= 0.0f)
        return false;
    // All points of the blade are within its height of its base, so rays to them turn by at most
    // asin(height/distance) ≤ π/2 · height/distance.
    const float sine = min(sqrt(1.0f - cosine * cosine) + 1.58f * blade.height / distance, 1.0f);
    const float widest = outlineMost * blade.width * widthFactor * sine;
    return keptSamples(widest / (view.minWidth * nearest), blade.seed, view.samples) == 0u;
}

/// The cull result of one blade of a visible patch, in the order orientation, frustum, distance,
/// level of detail. `limit`: leafAreaLimitOf() its patch; the blade is raised() by it.
SHARED_FN Verdict cullBlade(Eyepoint view, LeafAreaLimit limit, PosedBlade posed, float rank)
{
    const Blade blade = posed.blade;
    const float distance = length(blade.root - view.eye);
    const DrawnSize size = drawnSize(view, limit, blade, rank, distance);
    const float factor = size.widthFactor;

    Verdict verdict;
    verdict.cullResult = cullResultDrawn;
    verdict.widthFactor = factor;
    verdict.pixels = size.pixels;

    verdict.margin = 0.5f * outlineMost * blade.width * max(factor, 1.0f) +
                     sectionMargin(distance + blade.height, view.minWidth);
    bool outside = false;
    if ((view.cullMask & cullFrustum) != 0u)
        SHARED_UNROLL for (uint i = 0u; i < 6u; ++i) outside =
            outside || curveOutside(view.planes[i], posed.v0, posed.v1, posed.v2, verdict.margin);

    if ((view.cullMask & cullOrientation) != 0u &&
        seenTooNarrow(view, posed, factor > 0.0f ? factor : 1.0f))
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
