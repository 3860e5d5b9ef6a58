#pragma once

#include "bake/patches/cell_tree.h"
#include "field/field.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Blades that follow each other both in a cell and in a field, of one level of the cell's patches.
struct BladeRun {
    std::uint32_t cell;  ///< index in the cells that were laid out
    std::uint32_t first; ///< of the cell's blades
    std::uint32_t count; ///< at most maxRun
};

inline constexpr std::uint32_t maxRun = 1U << 16U; ///< blades

/// Joins the trees of 32 m cells, in any order, under the wider cells of the octree, and lays all
/// patches out level by level in `field`. Returns the order of the blades in the field. Looks at
/// patches and summaries of the cells alone. Omits cells with a single child and no blades. Throws
/// Error{input} if two cells have the same number.
std::vector<BladeRun> layOutCells(std::vector<CellTree>& cells, field::Field& field);

/// The same, and moves all blades and keys into `field`. Empties the cells as it goes.
void joinCells(std::vector<CellTree>&& cells, field::Field& field);

/// First blade of each level of a cell's patches, and the number of its blades last.
std::vector<std::uint32_t> levelsOf(const CellTree& cell);

} // namespace sward::bake
