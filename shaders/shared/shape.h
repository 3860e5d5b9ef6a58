// The outline of a blade and its tessellation. Jahrmann & Wimmer, I3D 2017, section 4.2, and the
// authors' demo.
#ifndef SWARD_SHARED_SHAPE_H
#define SWARD_SHARED_SHAPE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

// Species::shape.
SHARED_CONST uint shapeTriangleTip = 0u; ///< full width up to the tip threshold, then a point
SHARED_CONST uint shapeQuad = 1u;        ///< full width
SHARED_CONST uint shapeTriangle = 2u;    ///< tapers to a point from the root on
SHARED_CONST uint shapeQuadratic = 3u;   ///< one edge straight, the other a parabola
SHARED_CONST uint shapeDandelion = 4u;   ///< lobes on both sides
SHARED_CONST uint shapeLeaf = 5u;        ///< a point at both ends, widest at the tip threshold
SHARED_CONST uint shapeStalkLeaf = 6u;   ///< a triangle-tip on a stalk: narrow at its base, too
SHARED_CONST uint shapeCount = 7u;

/// Number of shapes that have a name; shapeStalkLeaf has that of shapeTriangleTip.
SHARED_CONST uint namedShapes = 6u;

/// A leaf on a stalk is this wide at its base, in widths …
SHARED_CONST float baseWidth = 0.25f;
/// … and widens as a parabola up to this place along it.
SHARED_CONST float baseLength = 0.3f;

/// Lobes of a dandelion's leaf on each side; each needs segmentsPerLobe segments.
SHARED_CONST float dandelionLobes = 4.0f;
SHARED_CONST float segmentsPerLobe = 4.0f;

/// Left and right edge at `t` along the blade, relative to its curve, in widths: −½ … ½, a
/// dandelion's up to 0.55.
SHARED_FN vec2 outlineAt(uint shape, float tipThreshold, float t)
{
    float half_ = 0.5f;
    if (shape == shapeTriangleTip)
        half_ = 0.5f - 0.5f * max(t - tipThreshold, 0.0f) / max(1.0f - tipThreshold, 1e-3f);
    else if (shape == shapeTriangle)
        half_ = 0.5f - 0.5f * t;
    else if (shape == shapeQuadratic)
        return vec2(-0.5f, 0.5f - t * t);
    else if (shape == shapeDandelion) {
        // |sin x|·|cos x| = |sin 2x|/2 with x = π·lobes/2·(1 − t).
        const float rest = 1.0f - t;
        const float wave = abs(sin(3.14159265f * dandelionLobes * rest));
        half_ = 0.5f * sqrt(rest) * (2.0f - rest - sqrt(0.5f * wave));
    } else if (shape == shapeLeaf) {
        // Two parabolas that meet at the widest place.
        const float away = t < tipThreshold ? (tipThreshold - t) / max(tipThreshold, 1e-3f)
                                            : (t - tipThreshold) / max(1.0f - tipThreshold, 1e-3f);
        half_ = 0.5f - 0.5f * min(away * away, 1.0f);
    } else if (shape == shapeStalkLeaf) {
        const float before = max(1.0f - t / baseLength, 0.0f);
        half_ = (0.5f - 0.5f * max(t - tipThreshold, 0.0f) / max(1.0f - tipThreshold, 1e-3f)) *
                (1.0f - (1.0f - baseWidth) * before * before);
    }
    return vec2(-half_, half_);
}

/// Whether both edges always have the same distance from the curve.
SHARED_FN bool isEven(uint shape)
{
    return shape != shapeQuadratic;
}

/// Whether the edges' distance from the curve never grows towards the tip.
SHARED_FN bool isTapering(uint shape)
{
    return shape != shapeDandelion && shape != shapeLeaf && shape != shapeStalkLeaf;
}

/// Area below the outline of a shapeStalkLeaf, and its first moment ∫ t·width dt: those of the
/// triangle-tip less what the base lacks, with u = 1 − t/baseLength.
SHARED_FN vec2 momentsOfStalkLeaf(float tipThreshold)
{
    const float tau = tipThreshold;
    const float lacks = 1.0f - baseWidth;
    const float u = max(1.0f - tau / baseLength, 0.0f);
    const float taper = u * u * u * u * baseLength * baseLength / max(1.0f - tau, 1e-3f);
    return vec2(0.5f + 0.5f * tau - lacks * (baseLength / 3.0f - taper / 12.0f),
                (1.0f + tau + tau * tau) / 6.0f -
                    lacks * (baseLength * baseLength / 12.0f -
                             taper * baseLength * (1.0f / 12.0f - 0.05f * u)));
}

/// Area below the outline, in widths times lengths.
SHARED_FN float outlineArea(uint shape, float tipThreshold)
{
    if (shape == shapeTriangleTip)
        return 0.5f + 0.5f * tipThreshold;
    if (shape == shapeTriangle)
        return 0.5f;
    if (shape == shapeQuadratic || shape == shapeLeaf)
        return 2.0f / 3.0f;
    if (shape == shapeStalkLeaf)
        return momentsOfStalkLeaf(tipThreshold).x;
    return shape == shapeDandelion ? 0.57268f : 1.0f;
}

/// An outline divided into segments, as it is drawn.
struct Outline {
    uint shape;
    float tipThreshold;
    float segments; ///< whole, ≥ 1
    float scale;    ///< widening of the chords that restores the outline's area
};

/// Above this number of segments the chords' loss of area is negligible.
SHARED_CONST float exactSegments = 20.0f;

/// Maximum drawn width of an outline, in units of its width.
SHARED_CONST float outlineMost = 1.35f;

/// Sum of the outline's widths at all i / segments between root and tip.
SHARED_FN float innerWidths(uint shape, float tipThreshold, float segments)
{
    if (shape == shapeTriangleTip) {
        // The last `count` ones, from `first` on, lie in the taper: an arithmetic series.
        const float first = floor(tipThreshold * segments) + 1.0f;
        const float count = max(segments - first, 0.0f);
        const float beyond =
            0.5f * count * (first + segments - 1.0f) / segments - tipThreshold * count;
        return segments - 1.0f - beyond / max(1.0f - tipThreshold, 1e-3f);
    }
    float sum = 0.0f;
    for (float i = 1.0f; i < segments; i += 1.0f) {
        const vec2 edges = outlineAt(shape, tipThreshold, i / segments);
        sum += edges.y - edges.x;
    }
    return sum;
}

SHARED_FN Outline outlineOf(uint shape, float tipThreshold, float segments)
{
    Outline outline;
    outline.shape = shape;
    outline.tipThreshold = tipThreshold;
    outline.segments = segments;
    outline.scale = 1.0f;
    if (segments < 1.5f || segments > exactSegments)
        return outline;
    // So few chords leave out the base.
    if (shape == shapeStalkLeaf && segments < 3.5f)
        outline.shape = shapeTriangleTip;
    const vec2 first = outlineAt(outline.shape, tipThreshold, 0.0f);
    const vec2 last = outlineAt(outline.shape, tipThreshold, 1.0f);
    const float sum = 0.5f * (first.y - first.x + last.y - last.x) +
                      innerWidths(outline.shape, tipThreshold, segments);
    outline.scale = outlineArea(shape, tipThreshold) * segments / sum;
    return outline;
}

/// Width at the root and at the tip of the best single segment for an outline, by least squares: it
/// has the outline's area A and first moment M = ∫ t·width dt, so a + b·t with a = 4A − 6M, b = 12M
/// − 6A. With equal area alone there is too much below the tip, the part of grass that is visible
/// behind grass: far grass would be a tenth too bright.
SHARED_FN vec2 singleSegment(uint shape, float tipThreshold)
{
    if (shape == shapeTriangleTip)
        return vec2(1.0f + tipThreshold - tipThreshold * tipThreshold, tipThreshold * tipThreshold);
    if (shape == shapeTriangle)
        return vec2(1.0f, 0.0f);
    if (shape == shapeQuadratic)
        return vec2(7.0f / 6.0f, 1.0f / 6.0f);
    if (shape == shapeLeaf) {
        const float moment = 0.25f + tipThreshold * (1.0f / 6.0f);
        return vec2(8.0f / 3.0f - 6.0f * moment, 6.0f * moment - 4.0f / 3.0f);
    }
    if (shape == shapeStalkLeaf) {
        const vec2 moments = momentsOfStalkLeaf(tipThreshold);
        return vec2(4.0f * moments.x - 6.0f * moments.y, 6.0f * moments.y - 2.0f * moments.x);
    }
    return shape == shapeDandelion ? vec2(0.64894f, 0.49642f) : vec2(1.0f);
}

/// The edges at `t` as drawn.
SHARED_FN vec2 edgesAt(Outline outline, float t)
{
    if (outline.segments < 1.5f) {
        const vec2 ends = singleSegment(outline.shape, outline.tipThreshold);
        const float half_ = 0.5f * mix(ends.x, ends.y, t);
        return vec2(-half_, half_);
    }
    return outline.scale * outlineAt(outline.shape, outline.tipThreshold, t);
}

/// Number of segments of a blade by size on the screen: chords deviate from the curve by less than
/// a quarter of a pixel, and the outline is visible. At most `most`, except for a dandelion.
/// `heightPixels` are those of its length, `size` [m].
SHARED_FN float segmentsFor(vec3 v0, vec3 v1, vec3 v2, float size, uint shape, float heightPixels,
                            float widthPixels, float most)
{
    // L chords of a quadratic Bézier deviate from it by at most |v0 − 2 v1 + v2| / (4 L²).
    const float stray = length(v0 - 2.0f * v1 + v2) * (heightPixels / max(size, 1e-9f));
    const float curve = ceil(sqrt(stray));
    if (shape == shapeDandelion && widthPixels > 2.0f)
        return dandelionLobes * segmentsPerLobe;
    // A tip is visible if the blade is wider than a pixel; a leaf narrows at both ends, in curves.
    float tip = widthPixels > 3.0f ? 3.0f : (widthPixels > 1.0f ? 2.0f : 1.0f);
    if ((shape == shapeLeaf || shape == shapeStalkLeaf) && widthPixels > 3.0f)
        tip = widthPixels > 12.0f ? 8.0f : 4.0f;
    return clamp(max(curve, tip), 1.0f, max(most, 1.0f));
}

/// Segments by distance, in steps, instead of by size on the screen: those of the first step that
/// is farther, or the last step's beyond all steps.
struct LevelSteps {
    vec4 distance; ///< [m] ascending
    vec4 segments;
    uint count; ///< ≤ 4; 0: by size
};
SHARED_LAYOUT(LevelSteps, 36)

SHARED_FN float segmentsAt(LevelSteps steps, float distance)
{
    // Constant indices keep a GPU from placing the steps in memory.
    float segments = steps.segments[0];
    SHARED_UNROLL for (int i = 1; i < 4;
                       ++i) if (uint(i) < steps.count && distance >= steps.distance[i - 1])
        segments = steps.segments[i];
    return segments;
}

SHARED_END
#endif
