#pragma once

#include "bake/paint/box_tree.h"
#include "bake/paint/stroke.h"
#include "bake/paint/stroke_grid.h"
#include "core/bounds.h"
#include "shaders/shared/blade.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// How painted blades look.
struct PaintedLook {
    double height = 1.0;  ///< factor on the height of blades
    double dryness = 0.0; ///< [0, 1] share of blades that are dried
    glm::dvec3 lean{0.0}; ///< direction in which blades lean, at most 1 long
};

/// What strokes say at a point of the ground.
struct Painted {
    double density = 1.0; ///< relative to the bake's density; may be above 1
    PaintedLook look;
    double keepsSpecies = 1.0; ///< [0, 1] share of the blades whose species the ground chooses
    std::array<double, shared::maxSpecies> species{}; ///< share of each that is painted
};

/// Strokes prepared for millions of points. A point depends only on the strokes that reach it, in
/// their order. Thread-safe.
class Painting {
public:
    /// The strokes near `ground`, which is a box relative to `origin`. `origin` must be a multiple
    /// of a millimetre. `strokes` must outlive it.
    Painting(const Strokes& strokes, const glm::dvec3& origin, const Aabb& ground);

    /// False if no stroke reaches a position relative to the origin. May be true elsewhere.
    bool reaches(const glm::vec3& place) const { return grid_.holds(glm::dvec3(place)); }

    /// At a point with this unit normal, whose density without strokes is `density` [0, 1].
    Painted at(const glm::vec3& place, const glm::vec3& normal, double density) const;

    /// The largest density that a stroke near the ground asks for, at least 1.
    double highest() const { return highest_; }

    /// Whether a stroke may raise the density above 1 in a box.
    bool mayRaise(const Aabb& box) const;

private:
    // The strength of a stroke at a point, and the capsule that it comes from.
    struct Hit {
        std::uint32_t stroke;
        std::uint32_t segment;
        double share;
    };

    double reachOf(const StrokeSegment& segment, const glm::dvec3& place,
                   const glm::dvec3& normal) const;
    void findHits(const glm::dvec3& place, const glm::dvec3& normal, std::vector<Hit>& hits) const;
    double smoothed(const glm::dvec3& place, const glm::dvec3& normal, double base,
                    std::uint32_t before) const;
    double densityBefore(const glm::dvec3& place, const glm::dvec3& normal, double base,
                         std::uint32_t before, std::vector<Hit>& hits) const;

    const Strokes& strokes_;
    StrokeGrid grid_;
    BoxTree raising_;
    double highest_ = 1.0;
};

} // namespace sward::bake
