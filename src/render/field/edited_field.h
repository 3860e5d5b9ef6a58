#pragma once

#include "field/cells.h"
#include "field/delta.h"
#include "render/field/edit.h"
#include "render/field/field_tables.h"
#include "render/field/free_ranges.h"
#include "render/field/patch_sizes.h"
#include "render/field/top_tree.h"
#include "shaders/shared/patch_tree.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// Throws Error{input} that names the cell if a delta has another origin, unsorted cells, or an
/// index without a target.
void checkDelta(const field::Delta& delta, const glm::dvec3& origin);

/// The tables of a field whose 32 m cells may be replaced: its patch tree, and the places of its
/// blades. Cell by cell, the blades and the patches below a cell's own lie together; wider patches
/// and the cells' own come first, see TopTree. A cell that becomes bare keeps its own patch,
/// without blades. Tables only grow. Runs on the CPU; decision 0040.
class EditedField {
public:
    /// Levels of patches in a cell, at most.
    static constexpr std::uint32_t maxCellLevels = 32;

    /// Copies tree and keys; `field` must have keys. `walkStart`: see walkStarts(). `maxBlades`:
    /// places of blades at most. Throws as cellsOf(), and Error{unsupported} beyond maxBlades.
    EditedField(const field::FieldView& field, std::uint32_t walkStart, std::uint32_t maxBlades);

    /// Replaces cells. The result views the delta's blades. Throws, and changes nothing:
    /// Error{input} that names the cell if the delta has another origin or is damaged,
    /// Error{unsupported} beyond maxBlades.
    Edit apply(const field::Delta& delta);

    std::span<const shared::Patch> patches() const { return top_.patches(); }
    std::span<const shared::Subtree> subtrees() const { return top_.subtrees(); }

    /// For each non-empty patch its index, in the order of blades within a cell; else
    /// TopTree::noBlades.
    std::span<const std::uint32_t> entries() const { return entries_; }
    std::uint32_t entryEnd() const; ///< one past the last one in use

    /// Per shared::nonEmptyPatchStride places of blades: the entry where a search begins.
    std::span<const std::uint32_t> firstEntries() const { return firstEntries_; }

    FieldTables tables() const; ///< all of these

    std::uint32_t bladeCount() const { return bladeCount_; }
    std::uint32_t bladeRoom() const; ///< places of blades, free ones included
    std::uint32_t nonEmptyPatchCount() const { return nonEmptyPatches_; }
    const PatchSizes& sizes() const { return sizes_; }

    /// A walk begins with the first `count` patches: with all, if there are at most walkStart; else
    /// with the cells' own and wider ones.
    std::uint32_t walkStarts() const;
    std::uint32_t walkSteps() const; ///< dispatches of a walk

    /// The blades of a field at their places: those without a blade are zero.
    std::vector<shared::PackedBlade> placed(const field::FieldView& field) const;

    /// The place of each blade of a field, which must have the same cells: else Error{usage}.
    std::vector<std::uint32_t> placesOf(const field::FieldView& field) const;

private:
    struct Cell {
        PlaceRange below;  ///< patches below its own
        PlaceRange blades; ///< multiples of shared::nonEmptyPatchStride
        PlaceRange entries;
        std::vector<field::BladeKey> keys; ///< one per blade
    };

    void check(const field::Delta& delta) const;
    void followMove(const shared::PatchSource& moved, Edit& edit);
    void addSources(const field::CellChange& change, const Cell& former, Edit& edit) const;
    void forgetPatches(const field::CellIndex& index, const Cell& cell);
    void putPatches(const field::CellChange& change, const Cell& cell);
    void putEntries(const field::CellChange& change, Cell& cell, Edit& edit);
    void free(const Cell& cell, Edit& edit);
    static std::uint32_t slotOf(std::uint32_t own, const Cell& cell, std::uint32_t patch);
    PlaceRange takeBlades(std::uint32_t count);
    bool walksLevels() const;

    glm::dvec3 origin_;
    std::uint32_t walkStart_;
    std::uint32_t maxBlades_;
    TopTree top_;
    std::map<field::CellIndex, Cell> cells_;
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint32_t> firstEntries_;
    FreeRanges freeEntries_;
    FreeRanges freeStrides_; ///< of shared::nonEmptyPatchStride places of blades
    PatchSizes sizes_{{}};
    std::uint32_t bladeCount_ = 0;
    std::uint32_t nonEmptyPatches_ = 0;
    std::uint32_t levels_ = 0; ///< of the deepest cell there has been
};

} // namespace sward::render
