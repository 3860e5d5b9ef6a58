#pragma once

#include "bake/mask/soft_range.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Whether the bearing ground is a heightfield in all but name: at least 99 % of its area faces
/// ground-up, and it lies in one layer seen from there, within 2 %. Layers are counted at the
/// cells of a 256 × 256 grid. False for radial ground-up, and for ground without area.
bool isHeightfield(const terrain::GroundMesh& ground, const GroundUp& groundUp);

/// The slopes on which grass grows by itself: up to 45°, thinning out to 60°, on a heightfield; all
/// slopes of other ground.
SoftRange defaultSlope(const terrain::GroundMesh& ground, const GroundUp& groundUp);

} // namespace sward::bake
