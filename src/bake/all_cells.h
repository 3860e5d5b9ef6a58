#pragma once

#include "bake/report_totals.h"
#include "bake/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/progress.h"

#include <vector>

namespace sward::bake {

/// Bakes all 32 m cells of a whole ground: at once, or tile by tile where that would take too much
/// memory.
std::vector<CellTree> bakeAllCells(const GroundView& whole, const BakeSettings& settings,
                                   const BakePlan& plan, Totals& totals, Progress& progress);

/// Whether that is done tile by tile. The ray tree of the whole ground is then of no use.
bool needsTiles(const BakeSettings& settings, const BakePlan& plan);

} // namespace sward::bake
