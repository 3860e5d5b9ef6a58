#pragma once

#include "bake/ground/tile_region.h"
#include "bake/patches/cell_tree.h"
#include "bake/plan/plan.h"
#include "bake/plan/root_source.h"
#include "bake/report.h"
#include "bake/settings/settings.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::bake {

/// The whole ground or a part, with the features found on the whole.
struct GroundView {
    const terrain::GroundMesh& ground;
    const terrain::SurfaceFeatures& features;
    const terrain::SurfaceQuery* rays = nullptr; ///< of this ground; may be null
};

/// Values computed once for a whole ground before its tiles are baked.
struct BakePlan {
    Plan plan;
    RootPlan roots;
    std::optional<field::SeedMeadow> seeds; ///< of a bake that writes seeds
};

/// Result of a tile.
struct TileResult {
    std::vector<CellTree> cells;
    RootCounts counts;
    double spacingMinimum = 0.0; ///< [m]; 0 unless there are two Poisson-disk roots
    field::Seeds seeds;          ///< of its cells, with the plan's meadow; none in most bakes
    Report::Timing timing;
};

/// Bakes the cells of a tile. `part` is the whole ground or partOf() it with at least tileMargin().
/// A null `tile` means everything.
TileResult bakeTile(const GroundView& part, const BakeSettings& settings, const BakePlan& plan,
                    const TileRegion* tile, Progress& progress);

/// Whether anything casts rays, on ground that has triangles.
bool needsRays(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// Width of the ground around its cells that a tile needs [m].
double tileMargin(const terrain::GroundMesh& ground, const BakeSettings& settings,
                  const BakePlan& plan);

} // namespace sward::bake
