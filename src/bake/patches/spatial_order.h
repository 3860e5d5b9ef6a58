#pragma once

#include "bake/ground/root_sample.h"

namespace sward::bake {

/// Sorts roots along a Z-order curve (Morton 1966) through their bounds. Roots near in space become
/// near in memory, which speeds up rays, clumps and patches. The order depends only on positions
/// and keys.
void sortSpatially(const terrain::GroundMesh& ground, Roots& roots);

} // namespace sward::bake
