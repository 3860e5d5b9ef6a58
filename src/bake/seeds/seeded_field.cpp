#include "bake/seeds/seeded_field.h"

#include "bake/patches/patch_tree.h"
#include "bake/plan/sward_cover.h"
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
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace sward::bake {
namespace {

constexpr double widestStored = 2.0; // factor on widths, as planBake()

// Fewer blades are wider, and the ground shows the rest of the sward.
void thinStored(Plan& plan, field::SeedMeadow& meadow)
{
    const double missing = 1.0 / std::max(meadow.stored, 1e-9);
    plan.widening = std::min(std::sqrt(missing), widestStored);
    plan.thinned = std::clamp(missing / plan.widening, 1.0, field::maxThinned);
    meadow.storedWidening = plan.widening;
}

RootCounts storedRoots(const field::Field& field)
{
    RootCounts counts;
    const field::FieldView view = field::viewOf(field);
    for (std::size_t i = 0; i < view.blades.size(); ++i)
        counts.kept += std::uint64_t(!view.isRibbon(i));
    counts.proposed = counts.kept;
    return counts;
}

} // namespace

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
        watch.lap();
        const double before = processorSeconds();
        BakePlan plan = planWhole(whole, fullSettings(settings), diagnostics, progress);
        field::Seeds seeds = makeSeeds(whole, settings, plan, progress);
        report.timing.sample = watch.lap();
        report.timing.sampleBusy = processorSeconds() - before;
        report.seeds = {seeds.cells.size(), seeds.data.size(),
                        static_cast<double>(plan.plan.expected) * bladesPerRoot(settings.meadow)};
        thinStored(plan.plan, seeds.meadow);

        Growth growth;
        growth.region.share = static_cast<float>(seeds.meadow.stored);
        growth.widening = seeds.meadow.storedWidening;
        result.field = fieldWithoutBlades(ground, settings, plan, report);
        joinCells(growSeeds(field::viewOf(seeds), result.field.species, ground.origin, growth,
                            "seeds", progress),
                  result.field);
        result.field.seeds = std::make_shared<const field::SharedSeeds>(std::move(seeds));
        report.timing.traits = watch.lap();
        Totals totals;
        totals.counts = storedRoots(result.field);
        finishReport(report, totals, settings, plan, diagnostics);
    });
    report.output.patches = result.field.patches.size();
    report.warnings = diagnostics.warnings();
    return result;
}

} // namespace sward::bake
