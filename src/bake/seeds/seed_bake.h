#pragma once

#include "bake/seeds/seed_places.h"
#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "terrain/ground_mesh.h"

#include <functional>

namespace sward::bake {

/// Whether a bake of this ground writes seeds: if SeedUse says always, or auto and the closed sward
/// exceeds the budget and can be sown. Throws Error{usage} naming the setting that cannot be sown
/// if it says always.
bool writesSeeds(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// The settings of the full meadow that the seeds hold: with no budget.
BakeSettings fullSettings(const BakeSettings& settings);

/// Settles what the seeds of all cells of a ground have in common: fills in `plan.seeds`, and how
/// wide and how far from a closed sward the stored blades are. `plan` is that of fullSettings().
/// Throws Error{input} for triangles too wide for the units of a cell.
void planSeeds(const terrain::GroundMesh& ground, const BakeSettings& settings, BakePlan& plan);

/// Width of the ground around its cells that a tile of seeds needs [m].
double seedMargin(const terrain::GroundMesh& ground, const BakeSettings& settings,
                  const BakePlan& plan);

/// The parts and centres of the seeds of a meadow: see seedPlaces().
SeedPlaces seedPlacesOf(const terrain::GroundMesh& ground, const BakeSettings& settings,
                        const field::SeedMeadow& meadow, const TileRegion* tile);

/// Takes a cell of seeds; called by several threads, in any order.
using TakeSeedCell = std::function<void(const field::SeedCell& cell)>;

/// The seeds of a tile's cells, each of which `take` gets, too; a null `tile` means all. `part` is
/// the whole ground or partOf() it with at least seedMargin(), and has rays if needsRays(). A cell
/// has the same bytes in any tile. Throws Error{input} for ground that does not fit into cells,
/// Error{interrupted} when cancelled.
field::Seeds makeSeeds(const GroundView& part, const BakeSettings& settings, const BakePlan& plan,
                       const TileRegion* tile, const TakeSeedCell& take, Progress& progress);

} // namespace sward::bake
