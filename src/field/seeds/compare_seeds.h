#pragma once

#include "field/seeds/seeds.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::field {

/// Seeds of a field, and its origin [m].
struct PlacedSeeds {
    const SeedsView* seeds = nullptr; ///< null: none
    glm::dvec3 origin{0.0};           ///< world place of the corner of cell (0, 0, 0)
};

/// Differences of the seeds of two fields. Cells are paired by their place in the world.
struct SeedComparison {
    std::uint64_t first = 0;          ///< cells of the first field
    std::uint64_t second = 0;         ///< the same of the second
    std::uint64_t onlyFirst = 0;      ///< cells without one at that place
    std::uint64_t onlySecond = 0;     ///< the same of the second
    std::uint64_t differ = 0;         ///< paired cells in which anything differs
    std::vector<std::string> reasons; ///< empty: equal
};

/// Compares every number of both. Throws Error{input} naming "the first field" or "the second
/// field" if a cell that must be unpacked is damaged.
SeedComparison compareSeeds(const PlacedSeeds& first, const PlacedSeeds& second);

/// Names the values in which two meadows differ, as "density 40.0 and 50.0"; empty if in none.
std::string differencesOf(const SeedMeadow& first, const SeedMeadow& second);

} // namespace sward::field
