#pragma once

#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <vector>

namespace sward::bake {

/// How much of the sky a root sees: the share in [0, 1] of `settings.exposureRays` rays, spread
/// over the hemisphere about its normal in proportion to the cosine, that meet nothing within a
/// length. Thread-safe; a function of the root, the seed and what stands within that length.
class Exposure {
public:
    /// `rayLength` [m]; ground and query must outlive it.
    Exposure(const terrain::GroundMesh& ground, const BakeSettings& settings, double rayLength,
             const terrain::SurfaceQuery& query);

    /// 1 if there are no rays.
    double at(const RootSample& root) const;

private:
    struct Direction {
        double cos;
        double sin;
    };

    const terrain::GroundMesh& ground_;
    const terrain::SurfaceQuery& query_;
    std::uint64_t seed_;
    double rayLength_;
    std::vector<Direction> spiral_; ///< where each ray points, before the root's own turn
};

/// Each root's exposure.
std::vector<float> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                const BakeSettings& settings, double rayLength,
                                const terrain::SurfaceQuery& query, Progress& progress);

} // namespace sward::bake
