#pragma once

#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "bake/whole/report_totals.h"
#include "core/progress.h"
#include "terrain/query/surface_query.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace sward::bake {

/// What bounds the memory of a large bake. The bytes of a field do not depend on it.
struct TileLimits {
    double inOne = 12e6; ///< blades of a ground that is baked at once; more are baked in tiles
    double inTile = 4e6; ///< blades of such a tile, of about 130 bytes each; one cell at least

    /// Triangles of a ground whose ray tree is built at once, and of a tile of a larger ground. A
    /// triangle takes about 130 bytes of ray tree.
    std::size_t trianglesInOne = 6'000'000;
    std::size_t trianglesInTile = 500'000;
};

/// What a plan needs of a ground.
struct PreparedGround {
    terrain::SurfaceFeatures features;
    std::optional<terrain::SurfaceQuery>
        rays; ///< none if nothing casts rays, or each tile has its own
};

/// Finds the connections of a ground's triangles, and builds its ray tree beside that. Adds to the
/// times of a report.
PreparedGround prepareGround(const terrain::GroundMesh& ground, const BakeSettings& settings,
                             const TileLimits& limits, Report::Timing& timing);

/// Calls `bake` for each of `count` tiles of a ground that has cells, with the part of the ground
/// within `margin` of it and without a ray tree.
void forEachTile(const GroundView& whole, std::size_t count, double margin,
                 const std::function<void(const GroundView& part, const TileRegion& tile)>& bake);

/// Takes the result of a tile, one of several or the only one.
using TakeTile = std::function<void(TileResult&& tile)>;

/// Bakes all 32 m cells of a whole ground: at once, or tile by tile where that would take too much
/// memory.
void bakeAllCells(const GroundView& whole, const BakeSettings& settings, const BakePlan& plan,
                  const TileLimits& limits, const TakeTile& take, Progress& progress);

/// Whether the ground itself is too large for one ray tree, and one is needed.
bool hasManyTriangles(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const TileLimits& limits);

/// Whether a bake is done tile by tile. The ray tree of the whole ground is then of no use.
bool needsTiles(const terrain::GroundMesh& ground, const BakeSettings& settings,
                const BakePlan& plan, const TileLimits& limits);

} // namespace sward::bake
