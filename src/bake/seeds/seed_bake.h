#pragma once

#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "terrain/ground_mesh.h"

#include <string>

namespace sward::bake {

/// Whether a bake of this ground writes seeds: if SeedUse says always, or auto and the closed sward
/// exceeds the budget and can be sown. Throws Error{usage} naming the setting that cannot be sown
/// if it says always.
bool writesSeeds(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// The settings of the full meadow that the seeds hold: with no budget.
BakeSettings fullSettings(const BakeSettings& settings);

/// The seeds of a ground. `plan` is that of fullSettings(). Throws Error{input} for ground that
/// does not fit into cells, Error{interrupted} when cancelled.
field::Seeds makeSeeds(const GroundView& whole, const BakeSettings& settings, const BakePlan& plan,
                       Progress& progress);

} // namespace sward::bake
