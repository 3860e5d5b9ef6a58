#pragma once

#include "bake/habitat.h"
#include "bake/meadow.h"

#include <array>
#include <vector>

namespace sward::bake {

/// Of each species one number.
using PerSpecies = std::array<double, shared::maxSpecies>;

/// What part of the density at a root each species takes.
struct SpeciesShares {
    PerSpecies share{};
    double total = 0.0; ///< their sum, [0, 1]

    /// The species at `chance` in [0, 1) when shares are laid end to end; 0 if nothing grows.
    std::uint32_t at(double chance) const;
};

/// How the species of a meadow share the ground. The presence of a species at a root is its cover
/// times the weight of its habitat. Those of the highest priority take first, as much of the
/// density as their presences add up to, at most all of it, and divide it in proportion to share ×
/// presence; those of the next priority take from what is left, and so on. What nobody takes stays
/// bare: density is multiplied by min(1, sum of all presences). See docs/algorithms/masks.md.
class SpeciesMix {
public:
    /// The meadow must outlive it.
    explicit SpeciesMix(const Meadow& meadow);

    /// False if every place has the same shares, in all 1.
    bool needsPlace() const { return needsPlace_; }

    /// Which facts about a place are asked for.
    bool needsAltitude() const;
    bool needsCurvature() const;

    /// Weight of each species' own habitat at a root, and why the likeliest is unlikely.
    PerSpecies habitatWeights(const terrain::GroundMesh& ground, const RootSample& root,
                              const Site& site, Reject& reason) const;

    SpeciesShares shares(const PerSpecies& habitatWeights) const;

    /// Of places where all habitats have weight 1.
    const SpeciesShares& evenShares() const { return evenShares_; }

private:
    const Meadow& meadow_;
    std::vector<HabitatWeight> habitats_;
    std::vector<std::uint32_t> order_; ///< slots, highest priority first
    bool needsPlace_ = false;
    SpeciesShares evenShares_;
};

} // namespace sward::bake
