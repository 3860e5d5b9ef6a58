#include "bake/plan/root_source.h"

#include "bake/poisson/poisson_disk.h"
#include "core/error.h"
#include "core/expect.h"
#include "core/random.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

// A Poisson count is approached from above. What is left out costs evenness: half its share of ρ.
constexpr double surplus = 1.005;
constexpr double maxSurplus = 1.015;
constexpr int maxTries = 8;

// Spacing of the pilot, in spacings, and the least count that is worth one.
constexpr double pilotSpacing = 2.5;
constexpr std::uint64_t worthPilot = 20'000;

// Places that tell how much of the ground bears.
constexpr double bearingProbes = 65536.0;

using Priority = std::pair<double, std::uint64_t>;

Priority priorityOfRoot(const terrain::GroundMesh& ground, const BakeSettings& settings,
                        const RootSample& root)
{
    const field::BladeKey key = keyOf(ground, root);
    return {priorityOf(settings.seed, key), keyBits(key)};
}

// The amount that keeps the `count` roots of lowest priority.
Amount lowest(const terrain::GroundMesh& ground, const BakeSettings& settings, const Roots& roots,
              std::uint64_t count)
{
    std::vector<Priority> order(roots.size());
    tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
        order[i] = priorityOfRoot(ground, settings, roots[i]);
    });
    const auto nth = order.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::nth_element(order.begin(), nth, order.end());
    Amount amount;
    amount.priority = nth->first;
    amount.lastKey = nth->second;
    return amount;
}

// Removes Poisson disks where strokes lower the density. They still keep others away, so that no
// root moves.
void thinByPaint(const terrain::GroundMesh& ground, const BakeSettings& settings,
                 const RootFilter& filter, const TileRegion* counted, Sampling& sampling)
{
    std::vector<std::uint8_t> stays(sampling.roots.size(), 1);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, stays.size(), 4096),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const RootSample& root = sampling.roots[i];
                if (!filter.painting()->mayChangeDensity(root.position))
                    continue;
                Reject ignored = Reject::paint;
                const double chance = uniform(settings.seed, keyBits(keyOf(ground, root)),
                                              static_cast<std::uint32_t>(Dimension::paint)) *
                                      filter.weigh(root, 0.0, ignored);
                stays[i] = std::uint8_t(filter.paintedDensity(root, chance, ignored) > chance);
            }
        });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < stays.size(); ++i) {
        const RootSample& root = sampling.roots[i];
        if (stays[i] != 0)
            sampling.roots[kept++] = root;
        else if (counted == nullptr || counted->holds(root))
            ++sampling.rejected[static_cast<std::size_t>(Reject::paint)];
    }
    sampling.roots.resize(kept);
}

// RootPlan::bearing.
double bearingOf(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const RootFilter& filter, bool filtered, Progress& progress)
{
    const double area = bearingArea(ground, settings.sides);
    if (!filtered || area <= 0.0)
        return area;
    const Sampling probe =
        SurfaceSampler(ground, settings, filter).sample({bearingProbes / area}, progress);
    return area * double(probe.roots.size()) / double(std::max<std::uint64_t>(probe.proposed, 1));
}

void planPoissonCount(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const RootFilter& filter, std::uint64_t count, RootPlan& plan,
                      Progress& progress)
{
    const PoissonTuning tuning = tuningOf(settings);
    const double all = bearingArea(ground, settings.sides);
    if (count == 0 || all <= 0.0)
        return;
    // Where so little bears that no probe found it, the tries below find the spacing.
    const double area = plan.bearing.value_or(0.0) > 0.0 ? *plan.bearing : all;
    const double wanted = double(count) * surplus + 0.5 * std::sqrt(double(count));
    double yield = tuning.yield;
    plan.spacing = std::sqrt(yield * area / wanted);
    std::uint64_t most = 0;
    const SearchLimit limit(count);
    const auto sample = [&](double spacing) {
        return PoissonDisk(ground, settings, filter, spacing, plan.filtered, tuning)
            .sample(progress, nullptr, &limit);
    };
    if (plan.filtered && count >= worthPilot) {
        // Disks at the borders of what bears reach beyond it: the ground holds more of them, in
        // proportion to the spacing. A sparse pilot tells how many.
        const double wide = pilotSpacing * plan.spacing;
        const double found = double(sample(wide).roots.size());
        const double more = found * wide * wide / (yield * area) - 1.0;
        yield *= std::clamp(1.0 + more / pilotSpacing, 0.5, 2.0);
        plan.spacing = std::sqrt(yield * area / wanted);
    }
    for (int i = 0; i < maxTries; ++i) {
        Sampling sampling = sample(plan.spacing);
        const std::size_t found = sampling.roots.size();
        most = std::max<std::uint64_t>(most, found);
        const bool isClose = double(found) <= double(count) * maxSurplus + 100.0 || i >= 3;
        if (found >= count && (isClose || i + 1 == maxTries)) {
            if (found > count)
                plan.amount = lowest(ground, settings, sampling.roots, count);
            plan.sampled = std::make_shared<WholeSample>(WholeSample{&ground, std::move(sampling)});
            return;
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
    expect(filter.painting() == nullptr, "a plan of roots knows no strokes");
    const bool filtered = filter.needsAnything() || filterNeedsRays(ground, settings);
    if (settings.spread != Spread::uniform) {
        RootPlan roots;
        roots.filtered = filtered;
        roots.bearing = bearingOf(ground, settings, filter, filtered, progress);
        roots.spacing = plan.spacing;
        if (settings.count)
            planPoissonCount(ground, settings, filter, *settings.count, roots, progress);
        return roots;
    }
    RootPlan roots;
    roots.filtered = filtered;
    if (settings.count)
        roots.amount =
            SurfaceSampler(ground, settings, filter).amountFor(*settings.count, progress);
    else
        roots.amount.density = plan.density;
    return roots;
}

Sampling sampleRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const RootFilter& filter, const RootPlan& plan, Progress& progress,
                     const TileRegion* counted, double around)
{
    if (settings.spread == Spread::uniform)
        return SurfaceSampler(ground, settings, filter)
            .sample(plan.amount, progress, counted, around);
    if (plan.spacing <= 0.0)
        return {};
    Sampling sampling;
    if (counted == nullptr && plan.sampled && plan.sampled->ground == &ground) {
        sampling = std::move(plan.sampled->sampling);
        plan.sampled->ground = nullptr;
    } else {
        sampling =
            PoissonDisk(ground, settings, filter, plan.spacing, plan.filtered, tuningOf(settings))
                .sample(progress, counted);
    }
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
    if (filter.painting() != nullptr)
        thinByPaint(ground, settings, filter, counted, sampling);
    return sampling;
}

double rootReach(const BakeSettings& settings, const RootPlan& plan)
{
    if (plan.spacing <= 0.0)
        return 0.0;
    return PoissonDisk::reach(plan.spacing, plan.filtered, tuningOf(settings));
}

} // namespace sward::bake
