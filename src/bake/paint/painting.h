#pragma once

#include "bake/paint/box_tree.h"
#include "bake/paint/stroke_grid.h"
#include "bake/settings/stroke.h"
#include "core/bounds.h"
#include "shaders/shared/species.h"

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

/// Species of painted blades.
struct PaintedSpecies {
    double kept = 1.0; ///< [0, 1] share of the blades whose species the ground chooses
    std::array<double, shared::maxSpecies> share{}; ///< [0, 1] of each that is painted
};

/// Strokes prepared for millions of points. A point depends only on the strokes that reach it, in
/// their order. Places are relative to the origin, normals are unit. Thread-safe.
class Painting {
public:
    /// The strokes near `ground`, which is a box relative to `origin`. `origin` must be a multiple
    /// of a millimetre. `strokes` must outlive it.
    Painting(const Strokes& strokes, const glm::dvec3& origin, const Aabb& ground);

    /// False if no stroke changes the density at a place. May be true elsewhere.
    bool mayChangeDensity(const glm::vec3& place) const
    {
        return density_.holds(glm::dvec3(place));
    }

    /// Density relative to the bake's at a point that has `density` [0, 1] without strokes. May be
    /// above 1.
    double densityAt(const glm::vec3& place, const glm::vec3& normal, double density) const;

    PaintedSpecies speciesAt(const glm::vec3& place, const glm::vec3& normal) const;
    PaintedLook lookAt(const glm::vec3& place, const glm::vec3& normal) const;

    /// The largest density that a stroke near the ground asks for, at least 1.
    double highest() const { return highest_; }

    /// Whether a stroke may raise the density above 1 in a box.
    bool mayRaise(const Aabb& box) const;

    /// The strokes that change what these are named after.
    const StrokeGrid& density() const { return density_; }
    const StrokeGrid& species() const { return species_; }
    const StrokeGrid& look() const { return look_; }

private:
    // A stroke that reaches a point: its nearest capsule of those that belong to the same surface.
    struct Hit {
        std::uint32_t stroke;
        std::uint32_t segment;
        double squared; // of the distance
    };

    double shareOf(const StrokeGrid& grid, const Hit& hit) const;
    bool belongs(const StrokeSegment& segment, double along, const glm::dvec3& offset,
                 const glm::dvec3& normal) const;
    void findHits(const StrokeGrid& grid, const glm::dvec3& place, const glm::dvec3& normal,
                  std::vector<Hit>& hits) const;
    double smoothed(const glm::dvec3& place, const glm::dvec3& normal, double base,
                    std::uint32_t before) const;

    const Strokes& strokes_;
    // Each knows the strokes that change what it is named after.
    StrokeGrid density_;
    StrokeGrid species_;
    StrokeGrid look_;
    BoxTree raising_;
    double highest_ = 1.0;
};

} // namespace sward::bake
