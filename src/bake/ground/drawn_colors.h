#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Whether vertex colours are shown on a material. They are hidden where they serve as masks and
/// where an image gives the colour: colours painted on textured terrain are usually masks of some
/// tool.
bool showsVertexColors(const terrain::GroundMesh& ground, std::uint32_t material,
                       bool colorsAreMask);

/// Base colour of each material as drawn, linear. A material without image and colours that is
/// white or light grey has never been given a colour: it is drawn as earth.
std::vector<glm::vec3> drawnBaseColors(const terrain::GroundMesh& ground, bool colorsAreMask);

/// Colour of a vertex on a material, linear. What is stored as in images is squared, as blades take
/// the transfer curve everywhere: within 0.04 of sRGB.
glm::vec3 vertexColor(const terrain::GroundMesh& ground, std::uint32_t material,
                      std::uint32_t vertex);

} // namespace sward::bake
