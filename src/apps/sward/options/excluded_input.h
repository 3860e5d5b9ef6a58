#pragma once

#include "apps/sward/options/bake_options.h"
#include "core/diagnostics.h"

namespace sward::apps {

/// Loads the meshes of the request's excluded areas, in the same space as the ground.
void loadExcluded(BakeRequest& request, Diagnostics& diagnostics);

} // namespace sward::apps
