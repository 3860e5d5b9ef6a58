#include "field/inspect.h"

#include <algorithm>
#include <array>
#include <future>

namespace sward::field {
namespace {

// Sums over the blades of some patches.
struct Sums {
    std::uint64_t ribbons = 0;
    std::uint64_t inLeaves = 0;
    double heights = 0.0;
    double widths = 0.0;
    double heightLow = 1e300;
    double heightHigh = 0.0;
    std::array<std::uint64_t, shared::maxSpecies> perSpecies{};
};

Sums sumsOf(const FieldView& field, std::span<const shared::Patch> patches)
{
    Sums sums;
    for (const shared::Patch& patch : patches) {
        if (patch.childCount == 0)
            sums.inLeaves += patch.bladeCount;
        for (const shared::PackedBlade& bits :
             field.blades.subspan(patch.firstBlade, patch.bladeCount)) {
            const shared::Blade blade = shared::unpackBlade(bits, patch);
            if (shared::ribbonNumber(field.species[blade.species].look, blade) > 0) {
                ++sums.ribbons;
                continue;
            }
            sums.heights += double(blade.height);
            sums.widths += double(blade.width);
            sums.heightLow = std::min(sums.heightLow, double(blade.height));
            sums.heightHigh = std::max(sums.heightHigh, double(blade.height));
            ++sums.perSpecies[blade.species];
        }
    }
    return sums;
}

// The sums of equal parts of the patches, by a thread for each if there are many blades. The number
// of parts is fixed, so that means are the same on every machine.
Sums sumsOf(const FieldView& field)
{
    constexpr std::size_t parts = 16;
    constexpr std::size_t fewBlades = 200'000;
    const auto launch =
        field.blades.size() < fewBlades ? std::launch::deferred : std::launch::async;
    std::array<std::future<Sums>, parts> work;
    for (std::size_t i = 0; i < parts; ++i) {
        const std::size_t first = field.patches.size() * i / parts;
        const std::size_t last = field.patches.size() * (i + 1) / parts;
        work[i] =
            std::async(launch, [&field, patches = field.patches.subspan(first, last - first)] {
                return sumsOf(field, patches);
            });
    }
    Sums whole;
    for (std::future<Sums>& part : work) {
        const Sums sums = part.get();
        whole.ribbons += sums.ribbons;
        whole.inLeaves += sums.inLeaves;
        whole.heights += sums.heights;
        whole.widths += sums.widths;
        whole.heightLow = std::min(whole.heightLow, sums.heightLow);
        whole.heightHigh = std::max(whole.heightHigh, sums.heightHigh);
        for (std::size_t s = 0; s < whole.perSpecies.size(); ++s)
            whole.perSpecies[s] += sums.perSpecies[s];
    }
    return whole;
}

} // namespace

Summary summarise(const FieldView& field)
{
    Summary summary;
    summary.blades = field.blades.size();
    summary.patches = field.patches.size();
    summary.bounds = field.bounds();
    for (const GroundRange& range : field.ground->ranges)
        if (range.level == 0)
            summary.groundTriangles += range.indexCount / 3;
    for (const shared::Patch& patch : field.patches) {
        summary.levels = std::max(summary.levels, static_cast<int>(patch.level) + 1);
        if (patch.childCount == 0)
            ++summary.leaves;
    }

    const Sums sums = sumsOf(field);
    summary.ribbons = sums.ribbons;
    summary.perSpecies.assign(sums.perSpecies.begin(),
                              sums.perSpecies.begin() +
                                  static_cast<std::ptrdiff_t>(field.species.size()));
    summary.heightLow = field.blades.empty() ? 0.0 : sums.heightLow;
    summary.heightHigh = sums.heightHigh;
    if (summary.leaves > 0)
        summary.bladesPerLeaf = double(sums.inLeaves) / double(summary.leaves);
    summary.blades -= summary.ribbons;
    if (summary.blades > 0) {
        summary.heightMean = sums.heights / double(summary.blades);
        summary.widthMean = sums.widths / double(summary.blades);
    }
    return summary;
}

} // namespace sward::field
