#pragma once

#include "core/uninitialized.h"
#include "field/field.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::field {

/// Index of a 32 m cell on each axis of the world.
using CellIndex = std::array<std::int64_t, 3>;

/// A 32 m cell of a field.
struct FieldCell {
    CellIndex cell = {};                ///< number of the cell
    std::vector<std::uint32_t> patches; ///< of the field, level by level; [0] is the cell's own
};

/// The 32 m cells of a verified field, in the order of their numbers. Throws Error{unsupported} if
/// its patches do not follow the cells of the world: two of the topmost patches with blades share
/// one.
std::vector<FieldCell> cellsOf(const FieldView& field);

/// What a cell holds, apart from its field: places of children, parents and blades count from the
/// beginning of these arrays, levels from the cell.
struct CellContent {
    std::vector<shared::Patch> patches;              ///< level by level; [0] is the cell's own
    UninitializedVector<shared::PackedBlade> blades; ///< patch after patch
    UninitializedVector<BladeKey> keys;              ///< one per blade, if the field has keys
};

/// A copy of a cell.
CellContent contentOf(const FieldView& field, const FieldCell& cell);

} // namespace sward::field
