#pragma once

#include "apps/sward/options/bake_options.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::apps {

/// Loads the ground of a bake: its inputs joined in order, then the occluders, which bear nothing.
/// Completes the request's settings by it: a slope that the ground chooses, excluded areas, strokes
/// that are moved onto it. Throws
/// Error.
terrain::GroundMesh loadGround(BakeRequest& request, Diagnostics& diagnostics);

} // namespace sward::apps
