#pragma once

#include "bake/blades/clumps.h"
#include "bake/filter/root_filter.h"
#include "bake/settings/settings.h"

#include <cstdint>
#include <span>

namespace sward::bake {

/// What grows at a root, by its place and its clump.
struct BladeChoice {
    const Clumps::Clump* clump; ///< null if none is near
    std::uint32_t slot;         ///< of the species
    float heightWave;           ///< [-1, 1], see Meadow::heightWaves
};

/// Chooses clump and species of roots. Species drift: slow waves give each more room at some
/// places, at the cost of the others. Thread-safe.
class BladeChooser {
public:
    /// All arguments must outlive it. `scale` is the blade scale, which also scales the waves.
    BladeChooser(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
                 const RootFilter& filter, const Clumps& clumps);

    /// Chooses for several roots, as many as `choices` has room for. Each choice depends only on
    /// its own root. Fast if the roots lie near each other.
    void choose(std::span<const RootSample> roots, std::span<BladeChoice> choices) const;

private:
    void chooseBlock(std::span<const RootSample> roots, std::span<BladeChoice> choices) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    double scale_;
    const RootFilter& filter_;
    const Clumps& clumps_;
};

} // namespace sward::bake
