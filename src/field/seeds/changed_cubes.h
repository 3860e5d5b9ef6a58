#pragma once

#include "field/seeds/seeds.h"
#include "field/seeds/sow_unit.h"

#include <cstdint>

namespace sward::field {

/// The finest cubes of a 32 m cell in which its blades may differ between two contents of the same
/// cell: those of pieces that differ; all, if clumps or the largest height do.
UnitCell::Cubes changedCubes(const SeedCell& before, const SeedCell& after, std::uint32_t unitBits);

} // namespace sward::field
