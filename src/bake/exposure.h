#pragma once

#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <vector>

namespace sward::bake {

/// Each root's exposure in [0, 1]: the share of `settings.exposureRays` rays, spread over the
/// hemisphere about its normal in proportion to the cosine, that meet nothing within `rayLength`
/// [m].
std::vector<float> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                const BakeSettings& settings, double rayLength,
                                const terrain::SurfaceQuery& query, Progress& progress);

} // namespace sward::bake
