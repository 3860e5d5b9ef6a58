#include "bake/seeds/seeded_field.h"

#include "bake/patches/patch_tree.h"
#include "bake/seeds/grow_field.h"
#include "bake/seeds/seed_bake.h"
#include "bake/settings/threads.h"
#include "bake/whole/field_header.h"
#include "bake/whole/report_totals.h"
#include "bake/whole/whole_plan.h"
#include "core/stopwatch.h"
#include "terrain/query/surface_query.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

// Stalks and blades alone; ribbons have no roots.
RootCounts storedRoots(std::span<const CellTree> cells, std::span<const field::Species> species)
{
    RootCounts counts;
    field::FieldView view;
    view.species = species;
    for (const CellTree& cell : cells) {
        view.blades = cell.blades;
        for (std::size_t i = 0; i < view.blades.size(); ++i)
            counts.kept += std::uint64_t(!view.isRibbon(i));
    }
    counts.proposed = counts.kept;
    return counts;
}

} // namespace

TileResult bakeSeededTile(const GroundView& part, const BakeSettings& settings,
                          const BakePlan& plan, const TileRegion* tile, Progress& progress)
{
    TileResult result;
    Stopwatch watch;
    std::optional<terrain::SurfaceQuery> query;
    GroundView view{part.ground, part.features, part.rays};
    if (view.rays == nullptr && needsRays(part.ground, settings)) {
        progress.begin("rays", 1);
        view.rays = &query.emplace(part.ground);
    }
    result.timing.rays = watch.lap();
    const double before = processorSeconds();
    Growth growth;
    growth.region.share = static_cast<float>(plan.seeds->stored);
    growth.widening = plan.seeds->storedWidening;
    const std::vector<field::Species> species = fieldSpecies(settings.meadow);
    const CellGrower grower(*plan.seeds, species, part.ground.origin, growth);
    std::mutex growing;
    const auto grow = [&](const field::SeedCell& cell) {
        CellTree tree = grower.grow(cell, "seeds");
        if (tree.blades.empty())
            return;
        const std::lock_guard lock(growing);
        result.cells.push_back(std::move(tree));
    };
    result.seeds = makeSeeds(view, settings, plan, tile, grow, progress);
    // In the order of the seeds, whichever thread was first.
    std::sort(result.cells.begin(), result.cells.end(),
              [](const CellTree& a, const CellTree& b) { return a.cell < b.cell; });
    result.counts = storedRoots(result.cells, species);
    result.timing.sample = watch.lap();
    result.timing.sampleBusy = processorSeconds() - before;
    return result;
}

Report::Seeds seedsReport(const field::Seeds& seeds, std::size_t storedBlades)
{
    const double share = seeds.meadow.stored;
    return {seeds.cells.size(), seeds.data.size(), share > 0.0 ? double(storedBlades) / share : 0.0,
            share};
}

BakeResult bakeSeededField(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           int threads, Diagnostics& diagnostics, Progress& progress)
{
    validate(settings);
    BakeResult result;
    Report& report = result.report;
    withThreads(threadCount(threads), [&] {
        report = reportOf(ground, settings, threadCount(threads));
        Stopwatch watch;
        terrain::SurfaceFeatures features;
        std::optional<terrain::SurfaceQuery> rays;
        tbb::parallel_invoke(
            [&] {
                Stopwatch own;
                features = featuresOf(ground, settings);
                report.timing.topology = own.lap();
            },
            [&] {
                Stopwatch own;
                if (needsRays(ground, settings))
                    rays.emplace(ground);
                report.timing.rays = own.lap();
            });
        const GroundView whole{ground, features, rays ? &*rays : nullptr};
        BakePlan plan = planWhole(whole, fullSettings(settings), diagnostics, progress);
        planSeeds(ground, settings, plan);
        TileResult tile = bakeSeededTile(whole, settings, plan, nullptr, progress);
        Totals totals;
        totals.add(tile);
        result.field = fieldWithoutBlades(ground, settings, plan, report);
        watch.lap();
        joinCells(std::move(tile.cells), result.field);
        report.timing.patches = watch.lap();
        report.seeds = seedsReport(tile.seeds, result.field.blades.size());
        result.field.seeds = std::make_shared<const field::SharedSeeds>(std::move(tile.seeds));
        finishReport(report, totals, settings, plan, diagnostics);
    });
    report.output.patches = result.field.patches.size();
    report.warnings = diagnostics.warnings();
    return result;
}

} // namespace sward::bake
