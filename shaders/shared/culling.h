// Which blades are drawn: predicates without memory. Jahrmann & Wimmer, I3D 2017, section 6.
#ifndef SWARD_SHARED_CULLING_H
#define SWARD_SHARED_CULLING_H

#include "shaders/shared/cover.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Why a blade is not drawn; also the slots of the counters.
SHARED_CONST uint cullResultDrawn = 0u;
SHARED_CONST uint cullResultPatch = 1u;
SHARED_CONST uint cullResultOrientation = 2u;
SHARED_CONST uint cullResultFrustum = 3u;
SHARED_CONST uint cullResultDistance = 4u;
SHARED_CONST uint cullResultOcclusion = 5u;
SHARED_CONST uint cullResultLod = 6u;
SHARED_CONST uint cullResultCount = 7u;

// Bits of Frame::cullMask.
SHARED_CONST uint cullPatch = 1u;
SHARED_CONST uint cullOrientation = 2u;
SHARED_CONST uint cullFrustum = 4u;
SHARED_CONST uint cullDistance = 8u;
SHARED_CONST uint cullOcclusion = 16u;
SHARED_CONST uint leaveThinned = 32u; ///< no test: see thickEnough()

/// Cosine of the angle between view ray and width axis beyond which the paper leaves a blade out as
/// seen edge-on. Such blades still show up to 0.44 of their width: they pop while the camera turns.
SHARED_CONST float paperEdgeOnCosine = 0.9f;

/// Signed distance [m] of a point from a plane (unit normal, offset); positive inside.
SHARED_FN float planeDistance(vec4 plane, vec3 point)
{
    return dot(vec3(plane.x, plane.y, plane.z), point) + plane.w;
}

/// Whether the curve over v0, v1, v2, as wide as 2·`margin`, lies wholly outside `plane`. The curve
/// stays inside the triangle of its control points, so nothing visible is ever cut (the paper tests
/// root, tip and middle, and loses large blades whose three points all lie outside).
SHARED_FN bool curveOutside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)
{
    return max(max(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) <
           -margin;
}

/// Whether all of that curve, as wide as 2·`margin`, lies inside.
SHARED_FN bool curveInside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)
{
    return min(min(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) >
           margin;
}

/// Whether a box lies wholly outside `plane`.
SHARED_FN bool boxOutside(vec4 plane, vec3 low, vec3 high)
{
    const vec3 farthest = vec3(plane.x >= 0.0f ? high.x : low.x, plane.y >= 0.0f ? high.y : low.y,
                               plane.z >= 0.0f ? high.z : low.z);
    return planeDistance(plane, farthest) < 0.0f;
}

/// Cosine of the angle between the width axis of a blade and the ray from `eye` to its root.
SHARED_FN float edgeOnCosine(vec3 eye, vec3 root, vec3 axis)
{
    const vec3 ray = root - eye;
    return min(abs(dot(ray, axis)) / max(length(ray), 1e-6f), 1.0f);
}

/// Distance [m] of `eye` from a box; 0 inside.
SHARED_FN float boxDistance(vec3 eye, vec3 low, vec3 high)
{
    return length(max(max(low - eye, eye - high), vec3(0.0f)));
}

/// Whether the stepwise thinning keeps a blade of progressive rank `rank`: of `buckets` equal
/// shares of the blades the last ones go first, none is left from `last` [m] on (Jahrmann & Wimmer,
/// section 6.2). 0 buckets keep all.
SHARED_FN bool bucketsKeep(float buckets, float last, float distance, float rank)
{
    return buckets <= 0.0f || rank * buckets < floor(buckets * (1.0f - distance / last));
}

/// Blades near the end of the drawn share fade in over this part of it.
SHARED_CONST float lodFade = 0.1f;

/// The share at which every blade has faded in.
SHARED_CONST float lodFullShare = 1.0f / 0.9f;

/// Share of the local blades that is drawn where a typical blade is `pixels` wide at its root: all
/// while it covers `threshold` pixels or so, then in proportion to its width. What is left is drawn
/// wider, so the covered area stays. Continuous, in [1/256, lodFullShare].
SHARED_FN float lodShare(float pixels, float threshold)
{
    return clamp(pixels / threshold, 1.0f / 256.0f, lodFullShare);
}

/// Width factor of the blade with progressive rank `rank` in [0, 1) where `share` of the blades is
/// drawn; 0: not drawn. Continuous in rank and share, so nothing pops, and its mean over all ranks
/// is 1, so the covered area stays.
SHARED_FN float lodWidthFactor(float rank, float share)
{
    if (share >= lodFullShare)
        return 1.0f;
    const float fade = lodFade * share;
    const float weight = clamp((share - rank) / fade, 0.0f, 1.0f);
    // ∫ weight over ranks from 0 to 1; what lies beyond rank 1 is missing.
    const float beyond = max(share - 1.0f, 0.0f);
    const float mean = share - 0.5f * fade - 0.5f * beyond * beyond / fade;
    return weight / mean;
}

/// A ray is taken to meet the grass no flatter than at this cosine from the ground's normal: over a
/// crest it leaves the grass again.
SHARED_CONST float flattestRay = 1.0f / 96.0f;

/// m² of blade per m² of ground: no grass is taken to be denser.
SHARED_CONST float maxLeafArea = 64.0f;

/// Share of the local blades that is drawn where those behind are hidden: a ray at `cosine` from
/// the ground's normal crosses leafExtinction · leafArea / cosine of leaf area (Monsi & Saeki
/// 1953), and of that `most` is left, times the fourth power of the pixels that a blade is wide if
/// these are more than one: at the end of a field, where there is no more behind, one sees through.
SHARED_FN float leafAreaShare(float most, float leafArea, float cosine, float pixels)
{
    const float wide = max(pixels * pixels, 1.0f);
    return clamp(most * wide * wide * max(cosine, flattestRay) /
                     (leafExtinction * max(leafArea, 1e-6f)),
                 1.0f / 256.0f, lodFullShare);
}

/// Weight of the blade with progressive rank `rank` where `share` of the blades is drawn and the
/// others are hidden: those that are left stay as wide as they are, but for the last, which fade.
SHARED_FN float leafAreaWeight(float rank, float share)
{
    if (share >= lodFullShare)
        return 1.0f;
    return clamp((share - rank) / (lodFade * share), 0.0f, 1.0f);
}

/// None stands higher than that for those that are left out.
SHARED_CONST float maxHeightCompensation = 1.3f;

/// How many times as high the blades stand that are left where `share` of them is drawn and a ray
/// has grass before it at the share `one`, see leafAreaShare(): it sees as deep into it as its leaf
/// area lets it, which grows about with the cube of the depth for blades that taper and lean, and
/// so the grass ends where all of it would. `spread`, in [0, 1]: the tallest are so much taller
/// than the lowest, in halves of their height; 1 for all beyond. Fitted to plains, whose coverage
/// by bands of distance stays within 1.2 %. Of 1/1024ths, so that half a float holds it.
SHARED_FN float heightCompensation(float share, float one, float spread)
{
    if (share >= 1.0f)
        return 1.0f;
    const float full = min(one, 1.0f);
    const float sunk = pow(full / share, 1.0f / 3.0f) - pow(full, 1.0f / 3.0f);
    const float rise = clamp(1.0f + (0.4f + 0.2f * spread) * sunk, 1.0f, maxHeightCompensation);
    return floor(rise * 1024.0f + 0.5f) / 1024.0f;
}

/// Leaf area over a place of a blade, of what is above it where all are drawn, where `share` of
/// them is: the share itself among blades of one height, if they were straight; where some are
/// lower a ray that comes deeper sees their tips. `spread`: as for heightCompensation(). Fitted to plains,
/// of which no 32 x 32 pixels are brighter or darker by more than 2.3 of 255.
SHARED_FN float leafAreaLight(float share, float spread)
{
    return share >= 1.0f ? 1.0f : pow(share, 1.0f / (1.3f + 1.7f * spread));
}

SHARED_END
#endif
