#pragma once

#include "bake/local_ranks.h"
#include "bake/patch_header.h"
#include "bake/root_sample.h"
#include "bake/territory.h"
#include "core/progress.h"
#include "core/uninitialized.h"
#include "field/field.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// The patches of one 32 m cell with their blades. It depends on nothing outside the cell but the
/// order of its roots.
struct CellTree {
    CellNumber cell = {};
    std::vector<shared::Patch> patches; ///< level by level; [0] is the cell's own
    UninitializedVector<shared::PackedBlade> blades;
    UninitializedVector<field::BladeKey> keys; ///< one per blade
    SubtreeDescription::Summary summary = {};
};

/// Groups roots into the cells of an octree fixed in the world. From the top, a cell takes up to
/// 256 of its roots, the first ones in `order` (see progressive_order.h), for itself; what is left
/// goes to its children. One tree for each 32 m cell, sorted by cell. `blades` has the blade of
/// each root, which may stand beside it.
std::vector<CellTree> growCells(const terrain::GroundMesh& ground, const Roots& roots,
                                const UninitializedVector<shared::Blade>& blades,
                                const std::vector<std::uint64_t>& order, const LocalRanks& ranks,
                                Progress& progress);

} // namespace sward::bake
