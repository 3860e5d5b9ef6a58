#pragma once

#include "bake/blades/clumps.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::bake {

/// How the grass of whole clumps varies over the ground, in patches of 5 to 50 m: moist and dry
/// ones, by slow waves, slope and hollows; grazed ones, which are low; and lain ones, which wind and
/// rain have pressed down. Depends on the place, the seed and the ground within wideVariationReach. Thread-safe
/// once built. docs/algorithms/masks.md
class WideVariation {
public:
    /// Of one clump. Each is 0 without variation.
    struct Traits {
        float moisture = 0.0f; ///< [-1, 1]: dry to moist; 0 on the average of level ground
        float grazed = 0.0f;   ///< [-0.2, 0.8], 0 on the average: 0.8 where animals have grazed
        float lain = 0.0f;     ///< [0, 1]
    };

    /// All arguments must outlive it. `query` is needed, and hollows count, if
    /// the settings have exposure rays. `scale` is the blade
    /// scale, which also scales the patches.
    WideVariation(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
                  const Clumps& clumps, const terrain::SurfaceQuery* query);

    /// Of a clump, or of none if it is null.
    Traits at(const Clumps::Clump* clump) const;

    /// Direction in which the grass of a clump lies, where it does: down the slope, and with the
    /// wind on level ground. Of any length.
    glm::dvec3 lainTowards(const Clumps::Clump& clump) const;

    /// Factor of a blade's height, 1 on the average.
    double heightFactor(const Traits& traits) const;

    /// Number of a clump, of which shared::clumpTone() is light and yellow in dry and grazed places,
    /// dark and blue in moist ones. `given`: its random number, which it keeps without variation.
    std::uint32_t clumpNumber(std::uint32_t given, const Traits& traits) const;

    /// Part of the moisture that the ground's form gives a place on a triangle: dry slopes, moist
    /// hollows. [-1.7, 0.7]; 0 on level ground.
    static double moistureOfGround(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                   double scale, const terrain::SurfaceQuery* query,
                                   std::uint32_t triangle, glm::dvec3 place);

private:
    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const Clumps& clumps_;
    double amount_;
    glm::dvec3 wind_;
    std::vector<Traits> traits_;        ///< by clump; empty: no variation
    std::vector<std::uint8_t> byTone_;  ///< the numbers of clumps, from dark to light
    std::vector<std::uint8_t> placeOf_; ///< of each number in that order
};

} // namespace sward::bake
