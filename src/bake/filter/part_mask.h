#pragma once

#include "bake/filter/site_range.h"
#include "bake/mask/mask.h"

namespace sward::bake {

/// Whether a mask surely is 0 at every place of a part. Reads the vertex attribute at the part's
/// corners, or the pixels under it, if these are at most 4096. False for the ground's green.
bool isZeroOn(const Mask& mask, const terrain::GroundMesh& ground, const GroundPart& part);

} // namespace sward::bake
