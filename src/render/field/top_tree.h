#pragma once

#include "field/cells.h"
#include "render/field/free_ranges.h"
#include "shaders/shared/edits.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/patch_tree.h"

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace sward::render {

/// The patch table of an edited field. Its first places hold the octree of cells wider than 32 m
/// and the own patches of 32 m cells; patches below these lie behind. Children of a patch are
/// neighbours: a new cell moves those of its parent. `level` is not kept.
class TopTree {
public:
    static constexpr std::uint32_t noBlades = 1; ///< a patch that is always empty

    /// Room for the tree of `cells` cells and as many more.
    explicit TopTree(std::size_t cells);

    /// The place of a cell's own patch; noPatch if there has been no such cell.
    std::uint32_t find(const field::CellIndex& cell) const;

    /// The cell whose own patch is at a place; null if that is another patch.
    const field::CellIndex* cellAt(std::uint32_t place) const;

    /// The same as find(); adds a cell without blades.
    std::uint32_t add(const field::CellIndex& cell);

    /// Places for patches below 32 m cells.
    PlaceRange take(std::uint32_t count);
    void give(PlaceRange range); ///< frees and empties them

    void set(std::uint32_t place, const shared::Patch& patch, const shared::Subtree& subtree);

    /// Computes the patches above the cells changed by set() or add() anew.
    void refresh();

    /// Places changed since the last call.
    std::vector<PlaceRange> takeChanged();

    /// Patches that have moved or are new since clearMoved().
    std::vector<shared::PatchSource> moved() const;
    void clearMoved() { movedFrom_.clear(); }

    /// Where a patch was then; noPatch: it is new.
    std::uint32_t before(std::uint32_t place) const;

    std::span<const shared::Patch> patches() const { return patches_; }
    std::span<const shared::Subtree> subtrees() const { return subtrees_; }
    std::uint32_t usedEnd() const;            ///< one past the last place in use
    std::uint32_t topEnd() const;             ///< the same of the first places
    bool isMixed() const { return isMixed_; } ///< these were too few: all places may hold any patch

private:
    /// A cell wider than 32 m: 2^shift of these along each axis.
    struct Wide {
        field::CellIndex number = {}; ///< index of its cells, shifted
        int shift = 0;
        bool contains(const field::CellIndex& cell) const;
    };

    PlaceRange takeTop(std::uint32_t count);
    void giveTop(PlaceRange range);
    void move(std::uint32_t from, std::uint32_t to);
    void change(std::uint32_t place) { changed_.insert(place); }
    std::uint32_t addChild(std::uint32_t parent);
    std::uint32_t split(std::uint32_t place, const field::CellIndex& cell);
    void own(std::uint32_t place, const field::CellIndex& cell);
    void gather(std::uint32_t place);
    void resize(std::uint32_t places);

    std::uint32_t top_; ///< number of first places
    std::vector<shared::Patch> patches_;
    std::vector<shared::Subtree> subtrees_;
    std::map<std::uint32_t, Wide> wide_;                ///< by place
    std::map<std::uint32_t, field::CellIndex> cellAt_;  ///< by place of the own patch
    std::map<field::CellIndex, std::uint32_t> placeOf_; ///< of a cell's own patch
    FreeRanges freeTop_;
    FreeRanges freeBelow_;
    bool isMixed_ = false;
    std::set<std::uint32_t> changed_;
    std::set<std::uint32_t> stale_;                    ///< whose ancestors are to be computed
    std::map<std::uint32_t, std::uint32_t> movedFrom_; ///< by place; noPatch: new
};

} // namespace sward::render
