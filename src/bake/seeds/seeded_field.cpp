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

#include <memory>
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
    result.seeds = makeSeeds(view, settings, plan, tile, progress);
    result.timing.sample = watch.lap();
    result.timing.sampleBusy = processorSeconds() - before;

    Growth growth;
    growth.region.share = static_cast<float>(result.seeds.meadow.stored);
    growth.widening = result.seeds.meadow.storedWidening;
    const std::vector<field::Species> species = fieldSpecies(settings.meadow);
    result.cells = growSeeds(field::viewOf(result.seeds), species, part.ground.origin, growth,
                             "seeds", progress);
    result.counts = storedRoots(result.cells, species);
    result.timing.traits = watch.lap();
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
