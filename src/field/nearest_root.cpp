#include "field/distributions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace sward::field {
namespace {

// The root of blade `index` of a patch, in double precision.
glm::dvec3 rootOf(const FieldView& field, const shared::Patch& patch, std::size_t index)
{
    return glm::dvec3(shared::unpackBlade(field.blades[index], patch).root);
}

// Searches the patch tree, whose boxes hold all roots below them.
class Search {
public:
    Search(const FieldView& field, const glm::dvec3& from, std::size_t self)
        : field_(field)
        , from_(from)
        , self_(self)
    {
    }

    std::optional<double> run()
    {
        visit(0);
        if (best_ == std::numeric_limits<double>::max())
            return std::nullopt;
        return std::sqrt(best_);
    }

private:
    double squaredDistance(const shared::Patch& patch) const
    {
        const glm::dvec3 nearest =
            glm::clamp(from_, glm::dvec3(patch.boundsLow), glm::dvec3(patch.boundsHigh));
        return glm::dot(nearest - from_, nearest - from_);
    }

    void visit(std::uint32_t index)
    {
        const shared::Patch& patch = field_.patches[index];
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
            const glm::dvec3 difference = rootOf(field_, patch, i) - from_;
            if (i != self_)
                best_ = std::min(best_, glm::dot(difference, difference));
        }

        // Near children first: what they find spares the far ones.
        std::array<std::pair<double, std::uint32_t>, 8> children;
        for (std::uint32_t c = 0; c < patch.childCount; ++c)
            children[c] = {squaredDistance(field_.patches[patch.firstChild + c]),
                           patch.firstChild + c};
        std::sort(children.begin(), children.begin() + patch.childCount);
        for (std::uint32_t c = 0; c < patch.childCount; ++c)
            if (children[c].first < best_)
                visit(children[c].second);
    }

    const FieldView& field_;
    glm::dvec3 from_;
    std::size_t self_;
    double best_ = std::numeric_limits<double>::max();
};

} // namespace

std::optional<double> nearestRootDistance(const FieldView& field, std::size_t index)
{
    // Patches follow one another in the order of their blades.
    const auto after = std::upper_bound(
        field.patches.begin(), field.patches.end(), index,
        [](std::size_t blade, const shared::Patch& p) { return blade < p.firstBlade; });
    const shared::Patch& patch = *(after - 1);
    return Search(field, rootOf(field, patch, index), index).run();
}

} // namespace sward::field
