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

#include <algorithm>
#include <iterator>
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

namespace {

// The seeds of tiles, cell by cell in rising order.
field::Seeds joinTiles(const std::vector<field::Seeds>& tiles, const field::SeedMeadow& meadow)
{
    struct Source {
        field::SeedEntry entry;
        std::size_t tile;
    };
    std::vector<Source> order;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        for (const field::SeedEntry& entry : tiles[t].cells)
            order.push_back({entry, t});
    std::sort(order.begin(), order.end(),
              [](const Source& a, const Source& b) { return a.entry.cell < b.entry.cell; });
    field::Seeds joined;
    joined.meadow = meadow;
    for (const Source& one : order)
        field::addSeedCell(joined, one.entry,
                           std::span<const std::byte>(tiles[one.tile].data)
                               .subspan(one.entry.offset, one.entry.bytes));
    return joined;
}

// All tiles of a ground, as one.
TileResult bakeInTiles(const GroundView& whole, const BakeSettings& settings, const BakePlan& plan,
                       const TileLimits& limits, Progress& progress)
{
    const terrain::GroundMesh& ground = whole.ground;
    const double margin = seedMargin(ground, settings, plan);
    TileResult all;
    std::vector<field::Seeds> seeds;
    Totals totals;
    const std::size_t count = ground.triangles.size() / limits.trianglesInTile + 1;
    forEachTile(whole, count, margin, [&](const GroundView& part, const TileRegion& region) {
        TileResult tile = bakeSeededTile(part, settings, plan, &region, progress);
        totals.add(tile);
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(all.cells));
        seeds.push_back(std::move(tile.seeds));
    });
    all.counts = totals.counts;
    all.timing = totals.timing;
    all.seeds = joinTiles(seeds, *plan.seeds);
    return all;
}

} // namespace

Report::Seeds seedsReport(const field::Seeds& seeds, std::size_t storedBlades)
{
    const double share = seeds.meadow.stored;
    return {seeds.cells.size(), field::viewOf(seeds).bytes(),
            share > 0.0 ? double(storedBlades) / share : 0.0, share};
}

BakeResult bakeSeededField(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           int threads, const TileLimits& limits, Diagnostics& diagnostics,
                           Progress& progress)
{
    validate(settings);
    BakeResult result;
    Report& report = result.report;
    withThreads(threadCount(threads), [&] {
        report = reportOf(ground, settings, threadCount(threads));
        Stopwatch watch;
        const auto [features, rays] = prepareGround(ground, settings, limits, report.timing);
        const GroundView whole{ground, features, rays ? &*rays : nullptr};
        BakePlan plan = planWhole(whole, fullSettings(settings), diagnostics, progress);
        planSeeds(ground, settings, plan);
        TileResult tile = hasManyTriangles(ground, settings, limits)
                              ? bakeInTiles(whole, settings, plan, limits, progress)
                              : bakeSeededTile(whole, settings, plan, nullptr, progress);
        Totals totals;
        totals.add(tile);
        // The provenance holds the blade scale of the report.
        finishReport(report, totals, settings, plan, diagnostics);
        result.field = fieldWithoutBlades(ground, settings, plan, report);
        watch.lap();
        joinCells(std::move(tile.cells), result.field);
        report.timing.patches = watch.lap();
        report.seeds = seedsReport(tile.seeds, result.field.blades.size());
        result.field.seeds = std::make_shared<const field::SharedSeeds>(std::move(tile.seeds));
    });
    report.output.patches = result.field.patches.size();
    report.warnings = diagnostics.warnings();
    return result;
}

} // namespace sward::bake
