#pragma once

#include "bake/seeds/seed_places.h"
#include "bake/seeds/seed_sites.h"
#include "bake/settings/settings.h"
#include "core/bounds.h"
#include "field/seeds/seeds.h"
#include "terrain/ground_mesh.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sward::bake {

/// Makes the seeds of 32 m cells. Thread-safe; a cell depends on what is listed for it alone.
class SeedCells {
public:
    /// All arguments must outlive it. `centreCount`: as of SeedPlaces.
    SeedCells(const terrain::GroundMesh& ground, const BakeSettings& settings,
              const field::SeedMeadow& meadow, const SeedUnits& units, const SeedSites& sites,
              std::size_t centreCount);

    /// A cell as it was before strokes changed.
    struct Former {
        const field::SeedCell& cell;                      ///< with pieces
        std::function<bool(const DAabb& part)> isTouched; ///< by strokes that changed, or almost
    };

    /// The seeds of a cell, from all parts and centres that SeedPlaces lists for it. Has no pieces
    /// if nothing grows there. Of parts that no stroke touches the conditions are taken from
    /// `former`, if it is given; the result is the same.
    field::SeedCell make(std::span<const SeedPlaces::Part> parts,
                         std::span<const SeedPlaces::Centre> centres,
                         const Former* former = nullptr) const;

private:
    class Builder;

    // Exposure of a vertex of bearing ground, the same for all its triangles; below 0 if rays find
    // an obstacle or a foot there. Rays leave once.
    float exposureAtVertex(std::uint32_t vertex, bool isBack) const;

    // Moisture of a clump's centre at a place relative to the ground's origin [m]. Rays leave once.
    std::int32_t moistureOf(const SeedCentre& centre, glm::dvec3 place) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const field::SeedMeadow& meadow_;
    const SeedUnits& units_;
    const SeedSites& sites_;
    std::vector<std::uint32_t> triangleOf_;             ///< the first that bears, of each vertex
    mutable std::vector<std::atomic<float>> exposures_; ///< of both sides of each vertex
    mutable std::vector<std::atomic<std::int32_t>> moistures_; ///< of each centre
};

} // namespace sward::bake
