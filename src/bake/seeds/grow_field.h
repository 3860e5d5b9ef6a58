#pragma once

#include "bake/patches/cell_tree.h"
#include "core/progress.h"
#include "field/field.h"
#include "field/seeds/sower.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sward::bake {

/// What is grown from seeds, and how.
struct Growth {
    field::SowRegion region;              ///< where, and up to which rank
    double widening = 1.0;                ///< factor on widths, by the steps of patches alone
    std::uint64_t maxBlades = UINT64_MAX; ///< more are an error, ribbons included
};

/// Grows cells of one meadow. Thread-safe. All arguments must outlive it.
class CellGrower {
public:
    CellGrower(const field::SeedMeadow& meadow, std::span<const field::Species> species,
               const glm::dvec3& origin, const Growth& growth);

    /// The patches and blades of a cell in the region; without blades if none grow there. Throws
    /// Error{input} naming `place` once more than maxBlades have grown in all cells.
    CellTree grow(const field::SeedCell& cell, const std::string& place) const;

private:
    field::Sower sower_;
    std::span<const field::Species> species_;
    const Growth& growth_;
    glm::dvec3 firstCell_; ///< number of the cell at the origin
    mutable std::atomic<std::uint64_t> blades_ = 0;
};

/// The patches and blades of all 32 m cells that the region touches. They depend on the seeds and
/// the region alone. Throws Error{input} naming `place` for damaged seeds and beyond maxBlades,
/// Error{interrupted} when cancelled.
std::vector<CellTree> growSeeds(const field::SeedsView& seeds,
                                std::span<const field::Species> species, const glm::dvec3& origin,
                                const Growth& growth, const std::string& place, Progress& progress);

/// A field of everything that `seeded` says but its blades and seeds, with the blades that its
/// seeds grow in a region. `threads` 0: all threads of the machine. Throws Error{usage} naming
/// `place` if it has no seeds, and as growSeeds() does.
field::Field growField(const field::FieldView& seeded, const Growth& growth, int threads,
                       const std::string& place, Progress& progress);

} // namespace sward::bake
