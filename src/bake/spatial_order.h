#pragma once

#include "bake/root_sample.h"

namespace sward::bake {

/// Sorts roots along a Z-order curve (Morton 1966) through their bounds: what is near in space
/// becomes near in memory, for the rays, clumps and patches that come after. The order depends on
/// places and keys alone.
void sortSpatially(const terrain::GroundMesh& ground, Roots& roots);

} // namespace sward::bake
