#include "bake/filter/crease_blend.h"

#include "bake/filter/species_mix.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sward::bake {
namespace {

// Least cosine between a root's normal and that of its side of a crease.
constexpr double sameSide = 0.7;

// How far a root may lie off the planes of a crease, as shares of the reach: beyond the other one,
// which is the way round a step below, and off its own, as curved ground does.
constexpr double maxBeyond = 0.1;
constexpr double maxOff = 0.5;

std::vector<DAabb> boxesOf(const std::vector<terrain::ConvexCrease>& creases)
{
    std::vector<DAabb> boxes;
    boxes.reserve(creases.size());
    for (const terrain::ConvexCrease& crease : creases) {
        DAabb& box = boxes.emplace_back();
        box.add(glm::dvec3(crease.from));
        box.add(glm::dvec3(crease.to));
    }
    return boxes;
}

// Height [m] of the higher blades at blade scale 1, by the species' shares, without the stalks of
// plants where there are others.
double swardHeight(const Meadow& meadow)
{
    const SpeciesMix mix(meadow);
    const SpeciesShares& shares = mix.evenShares();
    for (const bool withPlants : {false, true}) {
        double sum = 0.0;
        double weight = 0.0;
        for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
            if (withPlants || meadow.species[slot].organs.empty()) {
                sum += shares.share[slot] * meadow.species[slot].height.y;
                weight += shares.share[slot];
            }
        if (weight > 0.0)
            return sum / weight;
    }
    return 0.0;
}

glm::dvec3 nearestOnEdge(const terrain::ConvexCrease& crease, glm::dvec3 place)
{
    const glm::dvec3 from(crease.from);
    const glm::dvec3 along = glm::dvec3(crease.to) - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? glm::dot(place - from, along) / squared : 0.0;
    return from + std::clamp(share, 0.0, 1.0) * along;
}

} // namespace

CreaseBlend::CreaseBlend(const std::vector<terrain::ConvexCrease>& creases, double reach,
                         double amount)
    : creases_(creases)
    , reach_(reach)
    , amount_(amount)
    , tree_(amount > 0.0 && reach > 0.0 ? boxesOf(creases) : std::vector<DAabb>())
{
}

double creaseReach(const Meadow& meadow, double scale)
{
    return scale * swardHeight(meadow);
}

std::vector<std::size_t> CreaseBlend::near(const DAabb& box) const
{
    std::vector<std::size_t> found;
    if (!tree_.isEmpty())
        tree_.visit(DAabb{box.low - reach_, box.high + reach_},
                    [&](std::size_t index) { found.push_back(index); });
    std::sort(found.begin(), found.end());
    return found;
}

glm::dvec3 CreaseBlend::normalAt(const RootSample& root) const
{
    const glm::dvec3 own(root.normal);
    if (tree_.isEmpty())
        return own;
    const glm::dvec3 place(root.position);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    double largest = 0.0;
    // Sums in the order of the creases are the same in any part of the ground.
    for (const std::size_t index : near(DAabb{place, place})) {
        const terrain::ConvexCrease& crease = creases_[index];
        const glm::dvec3 offset = place - nearestOnEdge(crease, place);
        const double distance = std::sqrt(glm::dot(offset, offset));
        if (distance >= reach_)
            continue;
        glm::dvec3 here(crease.normals[0]);
        glm::dvec3 beyond(crease.normals[1]);
        if (glm::dot(here, own) < glm::dot(beyond, own))
            std::swap(here, beyond);
        if (glm::dot(here, own) < sameSide || glm::dot(offset, beyond) > maxBeyond * reach_ ||
            std::abs(glm::dot(offset, here)) > maxOff * reach_)
            continue;
        const double nearness = 1.0 - distance / reach_;
        const double weight = nearness * nearness;
        sum += weight * beyond;
        weights += weight;
        largest = std::max(largest, weight);
    }
    if (weights <= 0.0)
        return own;
    // Lengthen the mean of normals that stand across each other, so that three faces of a corner
    // meet on its diagonal. Opposite normals, of the two edges of a thin wall, cancel.
    const glm::dvec3 mean = sum / weights;
    const double lengthening = std::min(1.0 / std::max(glm::dot(mean, mean), 1e-12), 2.0);
    const glm::dvec3 turned = own + amount_ * largest * lengthening * mean;
    const double squared = glm::dot(turned, turned);
    return squared > 1e-12 ? turned / std::sqrt(squared) : own;
}

} // namespace sward::bake
