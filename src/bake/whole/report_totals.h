#pragma once

#include "bake/report.h"
#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <cstdint>

namespace sward::bake {

/// Sums over several tiles.
struct Totals {
    RootCounts counts;
    std::uint64_t blades = 0;    ///< in the cells of tiles: of a field with seeds those stored
    double spacingMinimum = 0.0; ///< [m]; 0: none was measured
    Report::Timing timing;

    void add(const TileResult& tile);

    /// Fills the report's counts, multiplied by `factor` for a sample.
    void fill(Report& report, double factor) const;
};

/// Makes a report of the input.
Report reportOf(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads);

/// Adds counts, distances and warnings after all tiles are baked. Throws Error{input} if the ground
/// keeps fewer roots than the count requires.
void finishReport(Report& report, const Totals& totals, const BakeSettings& settings,
                  const BakePlan& plan, Diagnostics& diagnostics);

} // namespace sward::bake
