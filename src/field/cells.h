#pragma once

#include "core/uninitialized.h"
#include "field/field.h"

#include <array>
#include <compare>
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

/// Side of the finest units in a 32 m cell: 1/16 of that.
constexpr std::uint32_t finestUnits = 4;

/// What is sown at once: half of the ranks of one level (shared::sowLevel()) in a cube of 32 m /
/// 2^n, with n three less than the level and at most finestUnits: about as many blades at each
/// level. The first half are the ranks up to twice the lowest. Level 0 has all in the second.
struct SowUnit {
    std::array<std::int32_t, 3> cell{};   ///< 32 m cell, as SeedEntry::cell
    std::uint32_t level = 0;              ///< of ranks, 0 to SeedMeadow::levels
    std::uint32_t half = 0;               ///< 0 or 1
    std::array<std::uint32_t, 3> place{}; ///< of the cube in the cell

    auto operator<=>(const SowUnit&) const = default; ///< some order
};

} // namespace sward::field
