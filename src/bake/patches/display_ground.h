#pragma once

#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// The ground for display: triangles grouped by material. Hidden vertex colours become white.
field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask);

} // namespace sward::bake
