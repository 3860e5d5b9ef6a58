#pragma once

#include "bake/cell_tree.h"
#include "bake/plan.h"
#include "bake/tile_region.h"
#include "bake/report.h"
#include "bake/root_source.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_features.h"
#include "terrain/surface_query.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Ground with what its connections tell, found once on the whole: all of it or a part.
struct GroundView {
    const terrain::GroundMesh& ground;
    const terrain::SurfaceFeatures& features;
    const terrain::SurfaceQuery* rays = nullptr; ///< of this ground, if somebody has made one
};

/// What is settled once for a whole ground before any tile of it is baked.
struct BakePlan {
    Plan plan;
    RootPlan roots;
};

/// What became of a tile.
struct TileResult {
    std::vector<CellTree> cells;
    RootCounts counts;
    double spacingMinimum = 0.0; ///< [m]; 0 unless roots are Poisson disks and there are two
    Report::Timing timing;
};

/// Bakes the cells of a tile. `ground` is the whole ground or partOf() it with at least
/// tileMargin(). A null `tile` means everything.
TileResult bakeTile(const GroundView& part, const BakeSettings& settings, const BakePlan& plan,
                    const TileRegion* tile, Progress& progress);

/// Whether anything at all is asked of rays, on ground that has triangles.
bool needsRays(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// How far around its cells a tile must know the ground [m].
double tileMargin(const terrain::GroundMesh& ground, const BakeSettings& settings,
                  const BakePlan& plan);

} // namespace sward::bake
