#pragma once

#include "bake/cell_tree.h"
#include "field/field.h"

#include <vector>

namespace sward::bake {

/// Joins the trees of 32 m cells, in any order, under the wider cells of the octree, and lays
/// patches and blades of it all out level by level in `field`. The cells are emptied as their
/// blades are moved. Cells with a single child and no blades are left out. Throws
/// Error{input} if two have the same number.
void joinCells(std::vector<CellTree>&& cells, field::Field& field);

} // namespace sward::bake
