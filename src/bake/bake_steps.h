#pragma once

#include "bake/bake_tile.h"
#include "bake/report.h"
#include "bake/settings.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <array>
#include <cstdint>
#include <functional>

namespace sward::bake {

/// What the settings ask of the connections of a whole ground; empty, and cheap, if nothing. Throws
/// Error{input} if the ground lacks what a setting asks for.
terrain::SurfaceFeatures featuresOf(const terrain::GroundMesh& ground,
                                    const BakeSettings& settings);

/// Settles what every tile of a ground is baked with. Throws as planBake() and planRoots() do.
BakePlan planWhole(const GroundView& whole, const BakeSettings& settings, Diagnostics& diagnostics,
                   Progress& progress);

/// What several tiles came to.
struct Totals {
    RootCounts counts;
    double spacingMinimum = 0.0; ///< [m]; 0: none was measured
    Report::Timing timing;

    void add(const TileResult& tile);

    /// Fills the report's counts, those of a sample multiplied by `factor`.
    void fill(Report& report, double factor) const;
};

/// A report that says what went in.
Report reportOf(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads);

/// Adds what is known once all tiles are baked: counts, distances, warnings. Throws Error{input} if
/// the ground keeps fewer roots than were counted on.
void finishReport(Report& report, const Totals& totals, const BakeSettings& settings,
                  const BakePlan& plan, Diagnostics& diagnostics);

/// Everything of a field but its patches and blades.
field::Field fieldWithoutBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report);

/// The ground's largest extent along an axis [m].
double extentOf(const terrain::GroundMesh& ground);

/// Threads that a number stands for; 0: as many as the machine has.
int threadCount(int threads);

/// Runs `work` on so many threads.
void withThreads(int threads, const std::function<void()>& work);

} // namespace sward::bake
