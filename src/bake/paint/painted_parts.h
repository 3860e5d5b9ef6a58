#pragma once

#include "bake/paint/box_tree.h"
#include "bake/paint/painting.h"
#include "bake/settings/stroke.h"
#include "core/bounds.h"

#include <limits>
#include <vector>

namespace sward::bake {

/// What strokes may change on a part of the ground.
struct PaintedPart {
    bool density = false; ///< which roots grow
    bool look = false;    ///< how blades look, their species included
    bool species = false; ///< shares of species
    double highest = 1.0; ///< the largest density that is asked for, at least 1
    double tallest = 1.0; ///< the largest factor on heights, at least 1
    double finest =
        std::numeric_limits<double>::infinity(); ///< [m] least radius of those of `look`
};

/// Finds what strokes may change in boxes on the ground. The answer depends on the box and on the
/// strokes that touch it alone. Thread-safe.
class PaintedParts {
public:
    /// Without strokes: nothing is painted.
    PaintedParts()
        : boxes_({})
    {
    }

    /// The strokes of a painting; both must outlive it.
    PaintedParts(const Painting& painting, const Strokes& strokes);

    /// Strokes whose capsules touch a box relative to the origin, or almost.
    PaintedPart in(const DAabb& box) const;

private:
    const Strokes* strokes_ = nullptr;
    std::vector<StrokeSegment> segments_; ///< a segment of several kinds of change is there once
    BoxTree boxes_;                       ///< of these segments
};

/// Whether a capsule, `more` [m] wider, touches a box, or almost.
bool doesTouch(const StrokeSegment& capsule, const DAabb& box, double more);

} // namespace sward::bake
