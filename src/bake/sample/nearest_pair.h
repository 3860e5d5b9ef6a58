#pragma once

#include "bake/ground/root_sample.h"
#include "bake/ground/tile_region.h"

namespace sward::bake {

/// Smallest distance [m] between two roots of one sheet, at most `limit`. Two roots are on one
/// sheet if the cosine between their normals is at least `sheetCosine`. Ignores pairs without a
/// root in `tile` (null: everywhere).
double nearestPair(const Roots& roots, double sheetCosine, double limit, const TileRegion* tile);

} // namespace sward::bake
