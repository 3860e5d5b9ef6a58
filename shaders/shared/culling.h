// Culling predicates without state. Jahrmann & Wimmer, I3D 2017, section 6.
#ifndef SWARD_SHARED_CULLING_H
#define SWARD_SHARED_CULLING_H

#include "shaders/shared/cover.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Cull results; also the slots of the counters.
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

/// Cosine between view ray and width axis from which on the paper culls a blade as edge-on. Such
/// blades still show up to 0.44 of their width: they pop while the camera turns.
SHARED_CONST float paperEdgeOnCosine = 0.9f;

/// Signed distance [m] of a point from a plane (unit normal, offset); positive inside.
SHARED_FN float planeDistance(vec4 plane, vec3 point)
{
    return dot(vec3(plane.x, plane.y, plane.z), point) + plane.w;
}

/// Whether the curve over v0, v1, v2 with width 2·`margin` lies completely outside `plane`. The
/// curve is inside the triangle of its control points, so no visible blade is culled. (The paper
/// tests root, tip and middle, and loses large blades with all three points outside.)
SHARED_FN bool curveOutside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)
{
    return max(max(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) <
           -margin;
}

/// Whether this curve with width 2·`margin` lies completely inside.
SHARED_FN bool curveInside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)
{
    return min(min(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) >
           margin;
}

/// Whether a box lies completely outside `plane`.
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

/// Whether the stepwise thinning keeps a blade of progressive rank `rank`. Of `buckets` equal
/// shares of the blades the last go first; none is left from `last` [m] on (Jahrmann & Wimmer,
/// section 6.2). 0 buckets keep all.
SHARED_FN bool bucketsKeep(float buckets, float last, float distance, float rank)
{
    return buckets <= 0.0f || rank * buckets < floor(buckets * (1.0f - distance / last));
}

/// Blades near the end of the drawn share fade in over this fraction of it.
SHARED_CONST float lodFade = 0.1f;

/// The share at which all blades have faded in.
SHARED_CONST float lodFullShare = 1.0f / 0.9f;

/// Share of the local blades that is drawn if a typical blade is `pixels` wide at its root: all
/// above about `threshold` pixels, then in proportion to the width. Drawn blades are widened to
/// keep the covered area. Continuous, in [1/256, lodFullShare].
SHARED_FN float lodShare(float pixels, float threshold)
{
    return clamp(pixels / threshold, 1.0f / 256.0f, lodFullShare);
}

/// Width factor of the blade with progressive rank `rank` in [0, 1) if `share` of the blades is
/// drawn; 0: not drawn. Continuous in rank and share, so nothing pops. Its mean over all ranks is
/// 1, so the covered area is kept.
SHARED_FN float lodWidthFactor(float rank, float share)
{
    if (share >= lodFullShare)
        return 1.0f;
    const float fade = lodFade * share;
    const float weight = clamp((share - rank) / fade, 0.0f, 1.0f);
    // ∫ weight over ranks from 0 to 1; the part beyond rank 1 is missing.
    const float beyond = max(share - 1.0f, 0.0f);
    const float mean = share - 0.5f * fade - 0.5f * beyond * beyond / fade;
    return weight / mean;
}

/// Minimum cosine between a ray in grass and the ground's normal: over a crest the ray leaves the
/// grass again.
SHARED_CONST float flattestRay = 1.0f / 96.0f;

/// m² of blade per m² of ground: upper bound of the assumed density.
SHARED_CONST float maxLeafArea = 64.0f;

/// Share of the local blades that is drawn under the leaf-area limit. A ray at `cosine` from the
/// ground's normal crosses leafExtinction · leafArea / cosine of leaf area (Monsi & Saeki 1953);
/// `most` of this is drawn. For blades wider than a pixel `most` is scaled by the fourth power of
/// their width in pixels: at the end of a field, without grass behind, gaps would show.
SHARED_FN float leafAreaShare(float most, float leafArea, float cosine, float pixels)
{
    const float wide = max(pixels * pixels, 1.0f);
    return clamp(most * wide * wide * max(cosine, flattestRay) /
                     (leafExtinction * max(leafArea, 1e-6f)),
                 1.0f / 256.0f, lodFullShare);
}

/// Weight of the blade with progressive rank `rank` if `share` of the blades is drawn and the
/// others are hidden: drawn blades keep their width, except the last, which fade.
SHARED_FN float leafAreaWeight(float rank, float share)
{
    if (share >= lodFullShare)
        return 1.0f;
    return clamp((share - rank) / (lodFade * share), 0.0f, 1.0f);
}

/// Upper bound of the height compensation.
SHARED_CONST float maxHeightCompensation = 1.3f;

/// Height factor of the drawn blades if `share` of them is drawn; at the share `one` a ray crosses
/// unit optical depth, see leafAreaShare(). A ray's depth is limited by the leaf area, which grows
/// about with the cube of the depth for blades that taper and lean. The factor keeps the visible
/// end of the grass in place. `spread`, in [0, 1]: height difference of tallest and lowest blade,
/// in halves of the tallest height; 1 for larger values. Fitted to plains, whose coverage by
/// distance band stays within 1.2 %. A multiple of 1/1024, to fit half a float.
SHARED_FN float heightCompensation(float share, float one, float spread)
{
    if (share >= 1.0f)
        return 1.0f;
    const float full = min(one, 1.0f);
    const float sunk = pow(full / share, 1.0f / 3.0f) - pow(full, 1.0f / 3.0f);
    const float rise = clamp(1.0f + (0.4f + 0.2f * spread) * sunk, 1.0f, maxHeightCompensation);
    return floor(rise * 1024.0f + 0.5f) / 1024.0f;
}

/// Factor on the leaf area above a place of a blade if `share` of the blades is drawn. For straight
/// blades of one height it would be the share itself; if some are lower, a deeper ray sees their
/// tips. `spread`: as for heightCompensation(). Fitted to plains, where no 32 x 32 pixels differ in
/// brightness by more than 2.75 of 255.
SHARED_FN float leafAreaLight(float share, float spread)
{
    return share >= 1.0f ? 1.0f : pow(share, 1.0f / (1.0f + 0.8f * spread));
}

SHARED_END
#endif
