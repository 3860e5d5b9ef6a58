#pragma once

#include "bake/settings.h"
#include "bake/surface_sampler.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Warns of what users take for a defect, with the option that mends it: no root kept at all, and
/// more than one per cent of the roots on undersides.
void warnAboutRoots(const Sampling& sampling, const terrain::GroundMesh& ground,
                    const BakeSettings& settings, Diagnostics& diagnostics);

} // namespace sward::bake
