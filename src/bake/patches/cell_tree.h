#pragma once

#include "bake/ground/root_sample.h"
#include "bake/ground/tile_region.h"
#include "bake/patches/local_ranks.h"
#include "bake/patches/patch_header.h"
#include "core/progress.h"
#include "core/uninitialized.h"
#include "field/field.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sward::bake {

/// The patches and blades of one 32 m cell. Depends only on the cell's roots and their order.
struct CellTree {
    CellNumber cell = {};
    std::vector<shared::Patch> patches; ///< level by level; [0] is the cell's own
    UninitializedVector<shared::PackedBlade> blades;
    UninitializedVector<field::BladeKey> keys; ///< one per blade
    SubtreeDescription::Summary summary = {};
};

/// Makes the blades of a root by its index: one, or the stalk of a plant and then its ribbons.
/// Called from several threads.
struct RootGrowth {
    /// 1 to 1 + shared::maxRibbons.
    std::function<std::uint32_t(std::size_t root)> count;
    /// Fills as many as `count` says.
    std::function<void(std::size_t root, std::span<GrownBlade> blades)> grow;
};

/// Groups roots into the cells of an octree fixed in the world. From the top, a cell keeps the
/// first of its roots in `order` (see progressive_order.h), with up to 512 blades, and passes the
/// rest to its children. A cell with slightly more than 512 keeps a fifth, so that the patches
/// below it are not nearly empty. The blades of a root stay together. Returns one tree for each 32
/// m cell, sorted by cell. Blades are grown and packed patch by patch, because unpacked blades
/// would dominate the memory.
std::vector<CellTree> growCells(const terrain::GroundMesh& ground, const Roots& roots,
                                const std::vector<std::uint64_t>& order, const LocalRanks& ranks,
                                const RootGrowth& growth, Progress& progress);

} // namespace sward::bake
