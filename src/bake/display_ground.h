#pragma once

#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// The ground as it is drawn: triangles grouped by material. Vertex colours are left white where
/// they serve as a mask (`colorsAreMask`).
field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask);

} // namespace sward::bake
