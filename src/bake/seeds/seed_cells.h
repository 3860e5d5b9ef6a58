#pragma once

#include "bake/seeds/seed_places.h"
#include "bake/seeds/seed_sites.h"
#include "bake/settings/settings.h"
#include "field/seeds/seeds.h"
#include "terrain/ground_mesh.h"

#include <span>

namespace sward::bake {

/// Makes the seeds of 32 m cells. Thread-safe; a cell depends on what is listed for it alone.
class SeedCells {
public:
    /// All arguments must outlive it.
    SeedCells(const terrain::GroundMesh& ground, const BakeSettings& settings,
              const field::SeedMeadow& meadow, const SeedUnits& units, const SeedSites& sites);

    /// The seeds of a cell, from all parts and centres that SeedPlaces lists for it. Has no pieces
    /// if nothing grows there.
    field::SeedCell make(std::span<const SeedPlaces::Part> parts,
                         std::span<const SeedPlaces::Centre> centres) const;

private:
    class Builder;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const field::SeedMeadow& meadow_;
    const SeedUnits& units_;
    const SeedSites& sites_;
};

} // namespace sward::bake
