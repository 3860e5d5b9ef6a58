#pragma once

#include "bake/local_ranks.h"
#include "bake/patch_header.h"
#include "bake/tile_region.h"
#include "bake/root_sample.h"
#include "core/progress.h"
#include "core/uninitialized.h"
#include "field/field.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <functional>
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

/// Grows the blade of a root, given its index; called from several threads.
using GrowBlade = std::function<shared::Blade(std::size_t root)>;

/// Groups roots into the cells of an octree fixed in the world. From the top, a cell takes up to
/// 512 of its roots, the first ones in `order` (see progressive_order.h), for itself; what is left
/// goes to its children. One that has some more than that keeps a fifth, so that the patches below
/// it are not nearly empty. One tree for each 32 m cell, sorted by cell. Blades grow patch by patch
/// and are packed at once: unpacked ones would take more memory than all the rest.
std::vector<CellTree> growCells(const terrain::GroundMesh& ground, const Roots& roots,
                                const std::vector<std::uint64_t>& order, const LocalRanks& ranks,
                                const GrowBlade& grow, Progress& progress);

} // namespace sward::bake
