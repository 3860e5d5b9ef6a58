#pragma once

#include "bake/settings/habitat.h"
#include "bake/settings/meadow.h"

#include <array>
#include <vector>

namespace sward::bake {

/// One number per species.
using PerSpecies = std::array<double, shared::maxSpecies>;

/// Share of the density at a root that each species takes.
struct SpeciesShares {
    PerSpecies share{};
    double total = 0.0; ///< their sum, [0, 1]

    /// Picks the species at `chance` in [0, 1) of the shares laid end to end; 0 if nothing grows.
    std::uint32_t at(double chance) const;
};

/// Divides the density between the species of a meadow. Presence of a species = cover × weight of
/// its habitat. Species of the highest priority come first: they take min(1, sum of their
/// presences) and divide it in proportion to share × presence. The next priority divides the
/// remainder, and so on. The rest stays bare: density is multiplied by min(1, sum of all
/// presences). See docs/algorithms/masks.md.
class SpeciesMix {
public:
    /// The meadow must outlive it.
    explicit SpeciesMix(const Meadow& meadow);

    /// False if all positions have the same shares with sum 1.
    bool needsPlace() const { return needsPlace_; }

    /// Which properties of a position the habitats use.
    bool needsAltitude() const;
    bool needsCurvature() const;

    /// Weight of each species' habitat at a root, and the factor that lowers the likeliest one.
    PerSpecies habitatWeights(const terrain::GroundMesh& ground, const RootSample& root,
                              const Site& site, Reject& reason) const;

    SpeciesShares shares(const PerSpecies& habitatWeights) const;

    /// Shares where all habitats have weight 1.
    const SpeciesShares& evenShares() const { return evenShares_; }

private:
    const Meadow& meadow_;
    std::vector<HabitatWeight> habitats_;
    std::vector<std::uint32_t> order_; ///< slots, highest priority first
    bool needsPlace_ = false;
    SpeciesShares evenShares_;
};

} // namespace sward::bake
