#pragma once

#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <vector>

namespace sward::bake {

/// Share of the sky visible from a root, [0, 1]. Casts `settings.exposureRays` cosine-distributed
/// rays over the hemisphere about the normal and returns the share that hits nothing. Thread-safe.
/// Depends only on the root, the seed and the scene within the ray length.
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

/// Exposure of each root.
std::vector<float> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                const BakeSettings& settings, double rayLength,
                                const terrain::SurfaceQuery& query, Progress& progress);

} // namespace sward::bake
