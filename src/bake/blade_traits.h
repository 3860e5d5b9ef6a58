#pragma once

#include "bake/clumps.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "shaders/shared/blade.h"
#include "terrain/ground_mesh.h"

#include <vector>

namespace sward::bake {

/// Gives every root the blade that stands on it: up-vector, facing, size, stiffness, species and
/// tint, each from the root's own random numbers and those of its clump. `scale` multiplies
/// lengths; an empty `exposure` is full exposure.
std::vector<shared::Blade> growBlades(const Roots& roots, const std::vector<float>& exposure,
                                      const terrain::GroundMesh& ground,
                                      const BakeSettings& settings, double scale,
                                      Progress& progress);

} // namespace sward::bake
