#pragma once

#include "apps/sward/bake_options.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::apps {

/// Loads the ground of a bake: its inputs joined in order, then the occluders, which bear nothing.
/// Throws Error.
terrain::GroundMesh loadGround(const BakeRequest& request, Diagnostics& diagnostics);

} // namespace sward::apps
