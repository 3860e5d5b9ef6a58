// A blade as a ribbon across the view: its edges as drawn, and the weight of each place.
#ifndef SWARD_SHARED_RIBBON_H
#define SWARD_SHARED_RIBBON_H

#include "shaders/shared/bezier.h"
#include "shaders/shared/shape.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// The drawn geometry of a blade. Positions are relative to the field's origin.
struct Ribbon {
    vec3 v0; ///< the curve's control points
    vec3 v1;
    vec3 v2;
    vec3 axis;   ///< unit, across
    float width; ///< [m] for an outline of 1
    float fold;  ///< [0, 1]: height of the ridge, see foldOf()
    Outline outline;
    uint seed; ///< see sampleMaskOf()
};

/// A cross-section of a ribbon.
struct CrossSection {
    vec3 left;
    vec3 right;
    vec3 ridge;  ///< the middle
    float wide;  ///< [m] width of the blade in the view …
    float drawn; ///< … and as drawn; the place has weight wide/drawn
};

/// The fold of a blade of this width on the screen: a blade hardly wider than a pixel keeps only
/// its outline.
SHARED_FN float foldOf(float fold, float widthPixels)
{
    return fold * smoothstep(2.0f, 4.0f, widthPixels);
}

/// Direction of the curve at `t`, towards the tip, not normalised.
SHARED_FN vec3 directionAt(Ribbon ribbon, float t)
{
    const vec3 tangent = bezierTangent(ribbon.v0, ribbon.v1, ribbon.v2, t);
    return dot(tangent, tangent) > 1e-18f ? tangent : ribbon.v1 - ribbon.v0;
}

/// Unit direction of the curve at `t`, towards the tip.
SHARED_FN vec3 tangentAt(Ribbon ribbon, float t)
{
    return normalize(directionAt(ribbon, t));
}

/// Direction in which a ribbon that is too narrow for its samples is widened: its component across
/// the view is unit `across`, and it follows `level` (any length) along the ground unless the blade
/// is nearly level itself. A tilted direction would put half of the added width below the ground.
SHARED_FN vec3 outwardsOf(vec3 across, vec3 level)
{
    const float square = dot(level, level);
    const vec3 unit = square > 1e-18f ? level * inversesqrt(square) : across;
    const float upright = dot(unit, across);
    return across + (upright / max(upright * upright, 0.25f)) * (unit - upright * across);
}

/// The cross-section at `t`. If its visible width is below `minWidth` [m at 1 m distance] (a far
/// blade, a tip, or an edge-on view), it is drawn with that width, across the view, and a lower
/// weight. So few rows of samples miss it.
SHARED_FN CrossSection crossSectionAt(Ribbon ribbon, float t, vec3 eye, float minWidth)
{
    const vec3 centre = bezierPoint(ribbon.v0, ribbon.v1, ribbon.v2, t);
    const vec3 direction = directionAt(ribbon, t);
    const vec2 edges = ribbon.width * edgesAt(ribbon.outline, t);

    CrossSection section;
    section.left = centre + edges.x * ribbon.axis;
    section.right = centre + edges.y * ribbon.axis;
    section.wide = edges.y - edges.x;
    section.drawn = section.wide;
    if (minWidth > 0.0f) {
        // Across the chords that meet here, not the curve: otherwise the last chords would be cut
        // at an angle and lose area. A chord from t to t + h has the curve's direction at t + h/2.
        const float half_ = 0.5f / max(ribbon.outline.segments, 1.0f);
        const vec3 chord = directionAt(ribbon, clamp(t, half_, 1.0f - half_));
        const vec3 ray = centre - eye;
        const float distance = length(ray);
        const vec3 side = cross(ray, chord);
        const float square = dot(side, side);
        // A blade that points at the eye shows its full width.
        const vec3 across = square > 1e-12f * dot(ray, ray) * dot(chord, chord)
                                ? side * inversesqrt(square)
                                : ribbon.axis;
        const float seen = dot(ribbon.axis, across);
        section.wide *= abs(seen);
        section.drawn = max(section.wide, minWidth * distance);
        const vec3 outwards = outwardsOf(across, cross(ray, ribbon.v1 - ribbon.v0));
        const vec3 grown =
            (0.5f * (section.drawn - section.wide) * (seen < 0.0f ? -1.0f : 1.0f)) * outwards;
        section.left -= grown;
        section.right += grown;
    }
    section.ridge = 0.5f * (section.left + section.right);
    if (ribbon.fold > 0.0f)
        section.ridge +=
            (0.5f * ribbon.fold * (edges.y - edges.x)) * normalize(cross(direction, ribbon.axis));
    return section;
}

/// Maximum added width on either side [m] of a drawn blade `distance` [m] away.
SHARED_FN float sectionMargin(float distance, float minWidth)
{
    return minWidth * distance;
}

/// Maximum distance of a ribbon's point from its curve [m]: for a ribbon of this width whose points
/// are at most `distance` [m] away.
SHARED_FN float marginBeside(float width, float distance, float minWidth)
{
    return 0.5f * outlineMost * width + sectionMargin(distance, minWidth);
}

/// Selects the samples that a blade keeps at a weight below 1. Different for each blade; a larger
/// weight keeps additional samples and drops none.
struct SampleMask {
    float threshold; ///< in (0, 1)
    uint first;      ///< the sample that is kept first; the others follow in cyclic order
    uint samples;    ///< per pixel
};

/// `seed`: Blade::seed.
SHARED_FN SampleMask sampleMaskOf(uint seed, uint samples)
{
    SampleMask mask;
    mask.threshold = (float(seed & 0x1fffu) + 0.5f) / 8192.0f;
    mask.first = (seed >> 13u) % samples;
    mask.samples = samples;
    return mask;
}

/// Number of samples of a pixel that a place of weight `weight` keeps: weight · samples on average
/// over blades.
SHARED_FN uint keptCount(SampleMask mask, float weight)
{
    return weight < 1.0f ? uint(max(weight, 0.0f) * float(mask.samples) + mask.threshold)
                         : mask.samples;
}

/// These samples, as bits.
SHARED_FN uint keptBits(SampleMask mask, float weight)
{
    const uint all = (1u << mask.samples) - 1u;
    const uint bits = (1u << min(keptCount(mask, weight), mask.samples)) - 1u;
    return ((bits << mask.first) | (bits >> (mask.samples - mask.first))) & all;
}

SHARED_FN uint keptSamples(float weight, uint seed, uint samples)
{
    return keptBits(sampleMaskOf(seed, samples), weight);
}

SHARED_END
#endif
