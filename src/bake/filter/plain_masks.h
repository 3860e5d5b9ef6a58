#pragma once

#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Warns of each mask, also of a species, that is white or black on all ground that bears grass: at
/// 16384 places, and for vertex colours at all corners. A mask of the ground's green is not tested.
/// Its images must be loaded. Call it with the whole ground.
void warnOfPlainMasks(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      Diagnostics& diagnostics);

} // namespace sward::bake
