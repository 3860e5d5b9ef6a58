#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <span>

namespace sward::bake {

/// Colour of the ground at a root: its material's image, averaged over nine texels, times the base
/// colour; without an image, times vertex colours. As stored in images (sRGB), [0, 1]. Approximates
/// the transfer curve by a square, within 0.04 of sRGB, to avoid functions that differ between
/// CPUs. `baseColors`: drawnBaseColors().
glm::vec3 groundColor(const terrain::GroundMesh& ground, const RootSample& root,
                      std::span<const glm::vec3> baseColors, bool colorsAreMask);

} // namespace sward::bake
