#pragma once

#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Whether vertex colours are shown on a material. They are hidden where they serve as masks and
/// where an image gives the colour: colours painted on textured terrain are usually masks of some
/// tool.
bool showsVertexColors(const terrain::GroundMesh& ground, std::uint32_t material,
                       bool colorsAreMask);

/// The ground for display: triangles grouped by material. Hidden vertex colours become white.
field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask);

} // namespace sward::bake
