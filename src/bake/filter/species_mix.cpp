#include "bake/filter/species_mix.h"

#include <algorithm>
#include <numeric>

namespace sward::bake {

std::uint32_t SpeciesShares::at(double chance) const
{
    double left = total * chance;
    std::uint32_t last = 0;
    for (std::uint32_t slot = 0; slot < share.size(); ++slot) {
        if (share[slot] <= 0.0)
            continue;
        last = slot;
        left -= share[slot];
        if (left < 0.0)
            break;
    }
    return last;
}

SpeciesMix::SpeciesMix(const Meadow& meadow)
    : meadow_(meadow)
    , order_(meadow.species.size())
{
    PerSpecies full{};
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot) {
        habitats_.emplace_back(meadow.species[slot].habitat);
        needsPlace_ = needsPlace_ || meadow.species[slot].habitat.needsAnything();
        full[slot] = 1.0;
    }
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return meadow.species[a].priority > meadow.species[b].priority;
    });
    evenShares_ = shares(full);
    needsPlace_ = needsPlace_ || evenShares_.total < 1.0;
}

bool SpeciesMix::needsAltitude() const
{
    return std::any_of(habitats_.begin(), habitats_.end(),
                       [](const HabitatWeight& one) { return one.habitat().needsAltitude(); });
}

bool SpeciesMix::needsCurvature() const
{
    return std::any_of(habitats_.begin(), habitats_.end(),
                       [](const HabitatWeight& one) { return one.habitat().needsCurvature(); });
}

PerSpecies SpeciesMix::habitatWeights(const terrain::GroundMesh& ground, const RootSample& root,
                                      const Site& site, Reject& reason) const
{
    PerSpecies weights{};
    double best = -1.0;
    for (std::size_t slot = 0; slot < habitats_.size(); ++slot) {
        Reject own = Reject::mask;
        weights[slot] = habitats_[slot].at(ground, root, site, 0.0, own);
        if (weights[slot] > best) {
            best = weights[slot];
            reason = own;
        }
    }
    return weights;
}

SpeciesShares SpeciesMix::shares(const PerSpecies& habitatWeights) const
{
    SpeciesShares result;
    double room = 1.0;
    for (auto first = order_.begin(); first != order_.end();) {
        // Process one priority at a time.
        const int priority = meadow_.species[*first].priority;
        const auto last = std::find_if(first, order_.end(), [&](std::uint32_t slot) {
            return meadow_.species[slot].priority != priority;
        });
        double presence = 0.0;
        double weights = 0.0;
        for (auto slot = first; slot != last; ++slot) {
            const SpeciesTraits& species = meadow_.species[*slot];
            const double own = species.cover * habitatWeights[*slot];
            presence += own;
            weights += result.share[*slot] = species.share * own;
        }
        // They take the sum of their presences, limited by the remaining room.
        const double taken = std::min(room, presence);
        for (auto slot = first; slot != last; ++slot)
            result.share[*slot] *= weights > 0.0 ? taken / weights : 0.0;
        room -= taken;
        first = last;
    }
    result.total = 1.0 - room;
    return result;
}

} // namespace sward::bake
