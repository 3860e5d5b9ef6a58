#pragma once

#include "field/cells.h"
#include "field/delta.h"
#include "field/field.h"
#include "render/field/edit.h"
#include "render/sowing/sown_tables.h"
#include "shaders/shared/blade.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace sward::render {

/// The stored blades of a sown field that is edited: cell by cell in its tables, as units that
/// never go. Each 32 m cell is a tree of its own. Runs on the CPU.
class StoredCells {
public:
    /// Puts the cells of a field with keys into tables that have no stored tree. Throws as
    /// field::cellsOf(), Error{usage} without keys.
    StoredCells(const field::FieldView& field, SownTables& tables);

    /// Tables without a stored tree, with room for these cells, and for cells that grow, beside
    /// what is sown.
    static std::unique_ptr<SownTables>
    tablesFor(const SownTables::Room& sown, const field::FieldView& field, std::uint32_t walkStart);

    /// Replaces a cell. Blades keep their states by key. `makeRoom` frees places, or returns false.
    /// Throws Error{runtime} if there is no room. The former places are free after retire().
    void replace(const field::CellChange& change, SownTables& tables, Edit& edit,
                 const std::function<bool()>& makeRoom);
    void retire(SownTables& tables, Edit& edit);

    /// The place of each blade of a field, which must have the same cells: else Error{usage}.
    std::vector<std::uint32_t> placesOf(const field::FieldView& field) const;

    /// The blades of a field at their places.
    std::vector<shared::PackedBlade> placed(const field::FieldView& field) const;

    std::size_t patchCount() const { return patchCount_; } ///< with blades

private:
    struct Cell {
        SownTables::Place place;
        std::vector<shared::Patch> patches; ///< with blades, counted from the cell's first
        std::vector<field::BladeKey> keys;  ///< one a blade
    };
    void addSources(const Cell& former, const Cell& now, Edit& edit, std::size_t firstTime) const;

    std::map<field::CellIndex, Cell> cells_;
    std::vector<SownTables::Place> retired_;
    std::size_t patchCount_ = 0;
};

} // namespace sward::render
