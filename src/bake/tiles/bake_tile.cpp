#include "bake/tiles/bake_tile.h"

#include "bake/blades/blade_traits.h"
#include "bake/filter/exposure.h"
#include "bake/filter/root_filter.h"
#include "bake/patches/local_ranks.h"
#include "bake/patches/spatial_order.h"
#include "bake/poisson/poisson_region.h"
#include "bake/sample/nearest_pair.h"
#include "bake/sample/progressive_order.h"
#include "core/stopwatch.h"

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace sward::bake {
namespace {

// Distance up to which roots affect a tile's order and ranks [m].
constexpr double orderReach = progressiveReach + LocalRanks::reach;

// Search limit of the minimum distance, in spacings.
constexpr double pairLimit = 1.25;

template <typename Keep>
void keepIf(Roots& roots, Keep keep)
{
    roots.erase(std::remove_if(roots.begin(), roots.end(),
                               [&](const RootSample& root) { return !keep(root); }),
                roots.end());
}

std::uint64_t countUndersides(const terrain::GroundMesh& ground, const Roots& roots,
                              const GroundUp& groundUp)
{
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_reduce(
        Range(0, roots.size(), 4096), std::uint64_t(0),
        [&](const Range& range, std::uint64_t count) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const glm::dvec3 up = groundUp.at(ground.origin + glm::dvec3(roots[i].position));
                count += std::uint64_t(glm::dot(glm::dvec3(roots[i].normal), up) < 0.0);
            }
            return count;
        },
        std::plus<>());
}

UninitializedVector<BladeChoice> chooseBlades(const BladeGrower& grower, const Roots& roots,
                                              Progress& progress)
{
    UninitializedVector<BladeChoice> choices(roots.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 4096),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          progress.throwIfCancelled();
                          grower.choose(std::span(roots).subspan(range.begin(), range.size()),
                                        std::span(choices).subspan(range.begin(), range.size()));
                      });
    return choices;
}

} // namespace

bool needsRays(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    return !ground.triangles.empty() &&
           (settings.exposureRays > 0 || filterNeedsRays(ground, settings) ||
            growsTufts(settings.meadow));
}

double tileMargin(const terrain::GroundMesh& ground, const BakeSettings& settings,
                  const BakePlan& plan)
{
    // Roots around the tile affect its progressive order. They depend on other roots around them,
    // and those depend on the reach of their filters.
    return (orderReach + rootReach(settings, plan.roots) +
            reachOf(ground, settings, plan.plan.scale, plan.plan.clumpSpacing)) *
           1.001;
}

TileResult bakeTile(const GroundView& part, const BakeSettings& settings, const BakePlan& plan,
                    const TileRegion* tile, Progress& progress)
{
    TileResult result;
    Stopwatch watch;
    const terrain::GroundMesh& ground = part.ground;
    std::optional<terrain::SurfaceQuery> query;
    const terrain::SurfaceQuery* rays = nullptr;
    if (needsRays(ground, settings)) {
        progress.begin("rays", 1);
        rays = part.rays != nullptr ? part.rays : &query.emplace(ground);
    }
    result.timing.rays = watch.lap();

    const double before = processorSeconds();
    // Sample the roots of the tile, and those around it that affect their order.
    const RootFilter filter(ground, settings, rays, &part.features, plan.plan.scale);
    Sampling sampling =
        sampleRoots(ground, settings, filter, plan.roots, progress, tile, orderReach);
    result.counts.proposed = sampling.proposed;
    result.counts.rejected = sampling.rejected;
    result.timing.sample = watch.lap();
    result.timing.sampleBusy = processorSeconds() - before;
    Roots& roots = sampling.roots;
    if (tile != nullptr)
        keepIf(roots,
               [&](const RootSample& root) { return tile->isNear(root.position, orderReach); });
    sortSpatially(ground, roots);
    if (plan.roots.spacing > 0.0 && roots.size() > 1)
        result.spacingMinimum = nearestPair(roots, tuningOf(settings).sheetCosine,
                                            pairLimit * plan.roots.spacing, tile);
    std::vector<std::uint64_t> order = progressiveOrder(
        ground, roots, settings.spread == Spread::uniform ? evenUniformShare : evenPoissonShare,
        &progress);
    const LocalRanks ranks(ground.origin, roots, order, progress);
    if (tile != nullptr) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (tile->holds(roots[i])) {
                roots[kept] = roots[i];
                order[kept++] = order[i];
            }
        roots.resize(kept);
        order.resize(kept);
    }
    result.counts.kept = roots.size();
    result.counts.undersides = countUndersides(ground, roots, settings.groundUp);
    result.timing.patches = watch.lap();

    std::vector<Surroundings> around;
    if (settings.exposureRays > 0 && rays != nullptr)
        around = castExposure(roots, ground, settings, plan.plan.scale, *rays, progress);
    result.timing.rays += watch.lap();

    const BladeGrower grower(ground, settings,
                             {plan.plan.scale, plan.plan.area, plan.plan.widening}, filter, rays,
                             &part.features);
    const UninitializedVector<BladeChoice> choices = chooseBlades(grower, roots, progress);
    result.cells = growCells(ground, roots, order, ranks,
                             {[&](std::size_t i) { return grower.bladesOf(choices[i]); },
                              [&](std::size_t i, std::span<GrownBlade> blades) {
                                  grower.grow(roots[i], around.empty() ? Surroundings() : around[i],
                                              choices[i], blades);
                              }},
                             progress);
    result.timing.traits += watch.lap();
    return result;
}

} // namespace sward::bake
