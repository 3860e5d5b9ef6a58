#pragma once

#include "bake/patches/cell_tree.h"
#include "field/field.h"

#include <vector>

namespace sward::bake {

/// The trees of the 32 m cells of a field, sorted by cell: joinCells() makes the same field of them
/// again. Copies. The field must be verified and have keys. Throws as field::cellsOf() does.
std::vector<CellTree> splitCells(const field::FieldView& field);

} // namespace sward::bake
