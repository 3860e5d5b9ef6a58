#include "bake/sample/root_source.h"

#include "bake/sample/poisson_disk.h"
#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sward::bake {
namespace {

// A Poisson count is approached from above: first attempt at this factor, later ones closer.
constexpr double surplus = 1.012;
constexpr double maxSurplus = 1.03;
constexpr int maxTries = 8;

using Priority = std::pair<double, std::uint64_t>;

Priority priorityOfRoot(const terrain::GroundMesh& ground, const BakeSettings& settings,
                        const RootSample& root)
{
    const field::BladeKey key = keyOf(ground, root);
    return {priorityOf(settings.seed, key), keyBits(key)};
}

RootPlan planPoissonCount(const terrain::GroundMesh& ground, const BakeSettings& settings,
                          const RootFilter& filter, bool filtered, std::uint64_t count,
                          Progress& progress)
{
    const PoissonTuning tuning = tuningOf(settings);
    RootPlan plan;
    plan.filtered = filtered;
    const double area = bearingArea(ground, settings.sides);
    if (count == 0 || area <= 0.0)
        return plan;
    const double wanted = double(count) * surplus + 2.0 * std::sqrt(double(count));
    plan.spacing = std::sqrt(tuning.yield * area / wanted);
    std::uint64_t most = 0;
    const SearchLimit limit(count);
    for (int i = 0; i < maxTries; ++i) {
        const Sampling sampling =
            PoissonDisk(ground, settings, filter, plan.spacing, plan.filtered, tuning)
                .sample(progress, nullptr, &limit);
        const std::size_t found = sampling.roots.size();
        most = std::max<std::uint64_t>(most, found);
        const bool isClose = double(found) <= double(count) * maxSurplus + 100.0 || i >= 3;
        if (found >= count && (isClose || i + 1 == maxTries)) {
            if (found == count)
                return plan;
            std::vector<Priority> order;
            order.reserve(found);
            for (const RootSample& root : sampling.roots)
                order.push_back(priorityOfRoot(ground, settings, root));
            const auto nth = order.begin() + static_cast<std::ptrdiff_t>(count) - 1;
            std::nth_element(order.begin(), nth, order.end());
            plan.amount.priority = nth->first;
            plan.amount.lastKey = nth->second;
            return plan;
        }
        // The number of roots is proportional to 1 / spacing².
        const double ratio = std::max(double(found), 1.0) / wanted;
        plan.spacing *= std::clamp(std::sqrt(ratio), 0.1, 10.0);
    }
    fail(ErrorKind::input, "--count {}: the ground keeps only {} Poisson disks", count, most);
}

} // namespace

RootPlan planRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const RootFilter& filter, const Plan& plan, Progress& progress)
{
    const bool filtered = filter.needsAnything() || filterNeedsRays(ground, settings);
    if (settings.spread != Spread::uniform) {
        if (settings.count)
            return planPoissonCount(ground, settings, filter, filtered, *settings.count, progress);
        return {{}, plan.spacing, filtered};
    }
    if (!settings.count)
        return {{plan.density}, 0.0, filtered};
    return {SurfaceSampler(ground, settings, filter).amountFor(*settings.count, progress), 0.0,
            filtered};
}

Sampling sampleRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const RootFilter& filter, const RootPlan& plan, Progress& progress,
                     const TileRegion* counted)
{
    if (settings.spread == Spread::uniform)
        return SurfaceSampler(ground, settings, filter).sample(plan.amount, progress, counted);
    if (plan.spacing <= 0.0)
        return {};
    Sampling sampling =
        PoissonDisk(ground, settings, filter, plan.spacing, plan.filtered, tuningOf(settings))
            .sample(progress, counted);
    if (!plan.amount.takesAll()) {
        const Priority last{plan.amount.priority, plan.amount.lastKey};
        const auto left = std::remove_if(
            sampling.roots.begin(), sampling.roots.end(), [&](const RootSample& root) {
                const bool tooMany = priorityOfRoot(ground, settings, root) > last;
                if (tooMany && (counted == nullptr || counted->holds(root)))
                    --sampling.proposed;
                return tooMany;
            });
        sampling.roots.erase(left, sampling.roots.end());
    }
    return sampling;
}

double rootReach(const BakeSettings& settings, const RootPlan& plan)
{
    if (plan.spacing <= 0.0)
        return 0.0;
    return PoissonDisk::reach(plan.spacing, plan.filtered, tuningOf(settings));
}

} // namespace sward::bake
