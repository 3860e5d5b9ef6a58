#include "field/measure/nearest_root.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace sward::field {
namespace {

constexpr double unreached = std::numeric_limits<double>::max();

glm::dvec3 rootOf(const FieldView& field, const shared::Patch& patch, std::size_t index)
{
    return glm::dvec3(shared::unpackBlade(field.blades[index], patch).root);
}

// Squared distance from `from` to the patch's box.
double squaredDistance(const shared::Patch& patch, const glm::dvec3& from)
{
    const glm::dvec3 nearest =
        glm::clamp(from, glm::dvec3(patch.boundsLow), glm::dvec3(patch.boundsHigh));
    const double squared = glm::dot(nearest - from, nearest - from);
    // NaN cannot be ordered.
    return squared < unreached ? squared : unreached;
}

} // namespace

void RootSearch::visit(const shared::Patch& patch, std::size_t self, const glm::dvec3& from,
                       double& best)
{
    ++visited_;
    for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
        if (field_.isRibbon(i))
            continue;
        const glm::dvec3 difference = rootOf(field_, patch, i) - from;
        if (i != self)
            best = std::min(best, glm::dot(difference, difference));
    }

    // Near children first: what they find prunes the far ones.
    const std::size_t before = waiting_.size();
    for (std::uint32_t c = 0; c < patch.childCount; ++c)
        waiting_.emplace_back(squaredDistance(field_.patches[patch.firstChild + c], from),
                              patch.firstChild + c);
    std::sort(waiting_.begin() + static_cast<std::ptrdiff_t>(before), waiting_.end(),
              std::greater<>());
}

std::optional<double> RootSearch::nearest(std::size_t index)
{
    // Patches are sorted by their blades.
    const auto after = std::upper_bound(
        field_.patches.begin(), field_.patches.end(), index,
        [](std::size_t blade, const shared::Patch& patch) { return blade < patch.firstBlade; });
    const glm::dvec3 from = rootOf(field_, *(after - 1), index);

    double best = unreached;
    waiting_.assign(1, {0.0, 0});
    while (!waiting_.empty()) {
        const auto [distance, patch] = waiting_.back();
        waiting_.pop_back();
        if (distance < best)
            visit(field_.patches[patch], index, from, best);
    }
    return best < unreached ? std::optional(std::sqrt(best)) : std::nullopt;
}

} // namespace sward::field
