#pragma once

#include "bake/tile_region.h"
#include "bake/root_sample.h"

namespace sward::bake {

/// Smallest distance [m] between two roots whose normals enclose an angle of a cosine of at least
/// `sheetCosine`, if it is at most `limit`, else `limit`. Pairs without a root in `tile` (null:
/// everywhere) are left out.
double nearestPair(const Roots& roots, double sheetCosine, double limit, const TileRegion* tile);

} // namespace sward::bake
