#include "bake/bake.h"

#include "bake/patches/patch_tree.h"
#include "bake/plan/plan.h"
#include "bake/sample/surface_sampler.h"
#include "bake/seeds/seed_bake.h"
#include "bake/seeds/seeded_field.h"
#include "bake/settings/threads.h"
#include "bake/whole/all_cells.h"
#include "bake/whole/field_header.h"
#include "bake/whole/report_totals.h"
#include "bake/whole/warnings.h"
#include "bake/whole/whole_bake.h"
#include "bake/whole/whole_plan.h"
#include "core/stopwatch.h"
#include "field/write.h"
#include "terrain/query/surface_query.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sward::bake {
namespace {

// Bytes a blade's candidate number adds for each doubling of the candidates on a triangle.
constexpr double bytesPerDoubling = 1.0 / 8.0;

} // namespace

Report bakeWhole(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                 const TileLimits& limits, const CellTakers& takers, Diagnostics& diagnostics,
                 Progress& progress)
{
    validate(settings);
    Report report;
    withThreads(threadCount(threads), [&] {
        report = reportOf(ground, settings, threadCount(threads));
        Stopwatch watch;
        // A plan casts no rays unless a filter of a count does.
        auto [features, rays] = prepareGround(ground, settings, limits, report.timing);
        GroundView whole{ground, features, rays ? &*rays : nullptr};
        watch.lap();
        const double before = processorSeconds();
        const BakePlan plan = planWhole(whole, settings, diagnostics, progress);
        report.timing.sample = watch.lap();
        report.timing.sampleBusy = processorSeconds() - before;
        const bool inTiles = needsTiles(ground, settings, plan, limits);
        if (inTiles) {
            // Each tile builds its own ray tree; free the memory of this one.
            whole.rays = nullptr;
            rays.reset();
        }
        takers.begin(inTiles);
        Totals totals;
        const auto take = [&](TileResult&& tile) {
            totals.add(tile);
            takers.take(std::move(tile));
        };
        bakeAllCells(whole, settings, plan, limits, take, progress);
        finishReport(report, totals, settings, plan, diagnostics);
        watch.lap();
        whole.rays = nullptr;
        rays.reset();
        takers.finish(takers.consumed != nullptr
                          ? fieldWithoutBlades(std::move(*takers.consumed), settings, plan, report)
                          : fieldWithoutBlades(ground, settings, plan, report));
        report.timing.patches += watch.lap();
    });
    report.warnings = diagnostics.warnings();
    return report;
}

BakeResult bakeField(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                     Diagnostics& diagnostics, Progress& progress)
{
    if (writesSeeds(ground, settings))
        return bakeSeededField(ground, settings, threads, {}, diagnostics, progress);
    BakeResult result;
    std::vector<CellTree> cells;
    CellTakers takers;
    takers.begin = [](bool) {};
    takers.take = [&](TileResult&& tile) {
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
    };
    takers.finish = [&](field::Field&& bare) {
        result.field = std::move(bare);
        joinCells(std::move(cells), result.field);
    };
    result.report = bakeWhole(ground, settings, threads, {}, takers, diagnostics, progress);
    result.report.output.patches = result.field.patches.size();
    return result;
}

Report estimateBake(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    Diagnostics& diagnostics, Progress& progress)
{
    validate(settings);
    Report report;
    constexpr double sampleSize = 400'000.0;
    withThreads(threadCount(threads), [&] {
        report = reportOf(ground, settings, threadCount(threads));
        // Bake a sparse field by the same steps …
        const double area = bearingArea(ground, settings.sides);
        const Plan full = planBake(area, extentOf(ground), settings, diagnostics);
        report.bladeScale = full.scale;
        report.densityClosed = full.closedDensity;
        report.widening = full.widening;
        if (area <= 0.0)
            return;
        BakeSettings thin = settings;
        thin.count.reset();
        thin.spacing.reset();
        const double wanted = settings.count ? sampleSize : full.expected;
        thin.density = std::min(wanted, sampleSize) / area;
        thin.bladeScale = full.scale;
        const terrain::SurfaceFeatures features = featuresOf(ground, thin);
        const GroundView whole{ground, features};
        const BakePlan plan = planWhole(whole, thin, diagnostics, progress);
        TileResult tile = bakeTile(whole, thin, plan, nullptr, progress);

        // … and scale its counts to the requested density or count.
        const double share = std::max(double(tile.counts.kept), 1.0);
        const double factor = settings.count
                                  ? (tile.counts.kept == 0 ? 0.0 : double(*settings.count) / share)
                                  : full.density / *thin.density;
        report.densityRequested = settings.count ? 0.0 : full.density;
        Totals totals;
        totals.add(tile);
        totals.fill(report, factor);
        warnAboutRoots(tile.counts, report.input, settings, full, diagnostics);
        field::Field sample = fieldWithoutBlades(ground, settings, plan, report);
        const double withoutBlades = double(field::fieldBytes(sample));
        joinCells(std::move(tile.cells), sample);
        const double withBlades = double(field::fieldBytes(sample));
        const std::size_t grown = sample.blades.size();
        report.output.patches = static_cast<std::uint64_t>(double(sample.patches.size()) * factor);
        const double perTriangle = double(grown) / double(ground.triangles.size());
        const double doublings =
            std::log2(std::max(perTriangle * factor, 1.0)) - std::log2(std::max(perTriangle, 1.0));
        report.output.bytes =
            static_cast<std::uint64_t>(withoutBlades + (withBlades - withoutBlades) * factor +
                                       double(grown) * factor * doublings * bytesPerDoubling);
    });
    report.warnings = diagnostics.warnings();
    return report;
}

} // namespace sward::bake
