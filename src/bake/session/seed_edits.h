#pragma once

#include "bake/ground/tile_region.h"
#include "bake/paint/stroke_grid.h"
#include "bake/patches/cell_tree.h"
#include "bake/seeds/seed_places.h"
#include "bake/session/cell_triangles.h"
#include "bake/settings/settings.h"
#include "bake/settings/stroke.h"
#include "bake/tiles/bake_tile.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"

#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

namespace sward::bake {

/// The seeds of a session. A change of strokes samples the conditions of those parts again that it
/// touches, and takes all others as they were. The cells are at any time those of makeSeeds() with
/// the session's strokes. Not thread-safe; uses several threads.
class SeedEdits {
public:
    /// What the seeds are made of. All must outlive the call that it is given to.
    struct Source {
        GroundView ground;                   ///< whole; without rays
        const CellTriangles& triangles;      ///< of it
        const std::set<CellNumber>& bearing; ///< all cells that may have seeds
        const BakeSettings& settings;        ///< their strokes are not looked at by apply()
        const BakePlan& plan;                ///< with seeds
    };

    /// What changed.
    struct Change {
        std::vector<CellNumber> cells; ///< sorted
        std::vector<CellTree> trees;   ///< stored blades of those that have any
    };

    /// Begins with the seeds of a bake with the session's strokes, of which it keeps a copy.
    explicit SeedEdits(const field::SeedsView& seeds);
    SeedEdits(SeedEdits&&) noexcept; ///< the former one may only be destroyed
    ~SeedEdits();

    /// Makes the cells again that changed strokes touch. `capsules`: of these, before and after, in
    /// the world, wide enough for strokes that look at them. `next`: all strokes after the change.
    /// Leaves everything as it was if it throws.
    Change apply(const Source& source, std::span<const StrokeSegment> capsules, const Strokes& next,
                 Progress& progress);

    /// Makes cells again of another ground.
    Change remake(const Source& source, const std::set<CellNumber>& cells, Progress& progress);

    /// The seeds of these cells, in their order; without pieces where nothing grows.
    std::vector<std::shared_ptr<const field::SeedCell>> cells(std::span<const CellNumber> numbers,
                                                              const glm::dvec3& origin) const;

    /// All seeds, as makeSeeds() makes them. A copy.
    field::Seeds seeds() const;

private:
    struct Workplace;

    std::shared_ptr<const field::SeedCell> cellAt(const SeedCellNumber& cell) const;
    field::Seeds baked_; ///< at the beginning
    std::map<SeedCellNumber, std::shared_ptr<const field::SeedCell>> changed_;
    std::unique_ptr<Workplace> workplace_; ///< around the cells that strokes have reached last
};

} // namespace sward::bake
