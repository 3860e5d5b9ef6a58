#pragma once

#include "field/seeds/compare_seeds.h"
#include "field/seeds/seeds.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace sward::field {

/// A field to join, with or without seeds.
struct SeedMember {
    PlacedSeeds placed;                     ///< its seeds and origin
    std::span<const std::uint32_t> species; ///< slot in the joined field of each of its species
    std::string name;                       ///< of its file, for messages
};

/// The seeds of fields that are joined to one with this origin and so many species; null if no
/// member has any. Cells keep their bytes and their places in the world. Throws Error{input} naming
/// the member whose seeds cannot be joined with those before: of another meadow, of cells that
/// another member has, too, off the grid of cells, or of species that have other slots.
std::shared_ptr<const SharedSeeds> joinSeeds(std::span<const SeedMember> members,
                                             const glm::dvec3& origin, std::size_t speciesCount);

} // namespace sward::field
