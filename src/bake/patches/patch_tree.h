#pragma once

#include "bake/patches/cell_tree.h"
#include "field/field.h"

#include <vector>

namespace sward::bake {

/// Joins the trees of 32 m cells, in any order, under the wider cells of the octree. Lays out all
/// patches and blades level by level in `field`. Empties the cells as it moves their blades. Omits
/// cells with a single child and no blades. Throws Error{input} if two cells have the same number.
void joinCells(std::vector<CellTree>&& cells, field::Field& field);

} // namespace sward::bake
