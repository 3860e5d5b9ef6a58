#pragma once

#include "bake/bake.h"

namespace sward::bake {

/// bakeField() of settings for which writesSeeds() holds: a field with seeds, and with the blades
/// of the lowest ranks. Throws as bakeField() and makeSeeds() do.
BakeResult bakeSeededField(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           int threads, Diagnostics& diagnostics, Progress& progress);

} // namespace sward::bake
