#pragma once

#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <vector>

namespace sward::bake {

/// Sets each root's exposure: the share of `settings.exposureRays` rays, spread over the hemisphere
/// about its normal in proportion to the cosine, that meet nothing within `rayLength` [m].
void castExposure(std::vector<RootSample>& roots, const terrain::GroundMesh& ground,
                  const BakeSettings& settings, double rayLength,
                  const terrain::SurfaceQuery& query, Progress& progress);

} // namespace sward::bake
