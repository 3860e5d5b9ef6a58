#pragma once

#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// The ground for display: triangles grouped by material. Hidden vertex colours become white.
field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask);

/// The same; frees each array of the ground as soon as the field has its own.
field::DisplayGround displayGround(terrain::GroundMesh&& ground, bool colorsAreMask);

} // namespace sward::bake
