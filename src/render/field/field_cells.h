#pragma once

#include "field/field.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::render {

/// Index of a 32 m cell on each axis of the world.
using CellIndex = std::array<std::int64_t, 3>;

/// A 32 m cell of a field.
struct FieldCell {
    CellIndex cell = {};
    std::vector<std::uint32_t> patches; ///< of the field, level by level; [0] is the cell's own
};

/// The 32 m cells of a field, in the order of their numbers. Throws Error{unsupported} if its
/// patches do not follow the cells of the world: two of the topmost patches with blades share one.
std::vector<FieldCell> cellsOf(const field::FieldView& field);

} // namespace sward::render
