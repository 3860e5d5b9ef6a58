#pragma once

#include "bake/bake.h"
#include "bake/whole/all_cells.h"

namespace sward::bake {

/// bakeTile() of a plan with seeds: the seeds of its cells, and the blades of the lowest ranks.
/// `part` is the whole ground or partOf() it with at least seedMargin(). Throws as makeSeeds()
/// does.
TileResult bakeSeededTile(const GroundView& part, const BakeSettings& settings,
                          const BakePlan& plan, const TileRegion* tile, Progress& progress);

/// What a report says of the seeds of a field with so many stored blades, ribbons included.
Report::Seeds seedsReport(const field::Seeds& seeds, std::size_t storedBlades);

/// bakeField() of settings for which writesSeeds() holds: a field with seeds, and with the blades
/// of the lowest ranks. Ground with more triangles than `limits` say is baked tile by tile; the
/// field is the same. Throws as bakeField() and makeSeeds() do.
BakeResult bakeSeededField(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           int threads, const TileLimits& limits, Diagnostics& diagnostics,
                           Progress& progress);

} // namespace sward::bake
