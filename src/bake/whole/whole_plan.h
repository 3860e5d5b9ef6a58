#pragma once

#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Finds the features of the whole ground that the settings use; empty, and cheap, if there are
/// none. Throws Error{input} if the ground lacks something that a setting needs.
terrain::SurfaceFeatures featuresOf(const terrain::GroundMesh& ground,
                                    const BakeSettings& settings);

/// Computes the plan shared by all tiles of a ground. Throws as planBake() and planRoots() do.
BakePlan planWhole(const GroundView& whole, const BakeSettings& settings, Diagnostics& diagnostics,
                   Progress& progress);

/// The ground's largest extent along an axis [m].
double extentOf(const terrain::GroundMesh& ground);

} // namespace sward::bake
