#pragma once

#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Whether vertex colours are shown on a material: not where they serve as masks, and not where an
/// image gives the colour, because what is painted over a textured terrain is a mask for some tool,
/// seldom a tint.
bool showsVertexColors(const terrain::GroundMesh& ground, std::uint32_t material,
                       bool colorsAreMask);

/// The ground as it is drawn: triangles grouped by material. Vertex colours are white where they
/// are not shown.
field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask);

} // namespace sward::bake
