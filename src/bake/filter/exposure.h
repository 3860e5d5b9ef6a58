#pragma once

#include "bake/ground/root_sample.h"
#include "bake/settings/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <vector>

namespace sward::bake {

/// What the rays of a root meet.
struct Surroundings {
    float exposure = 1.0f; ///< share [0, 1] of the rays that meet nothing
    float foot = 0.0f;     ///< [0, 1]: 1 at the foot of an occluder, 0 beyond its reach
};

/// Share of the sky visible from a root, [0, 1]. Casts `settings.exposureRays` cosine-distributed
/// rays over the hemisphere about the normal and returns the share that hits nothing. Thread-safe.
/// Depends only on the root, the seed and the scene within the ray length.
///
/// The two lowest blocked rays that rise by 20° or more find occluders that stand beside a root:
/// triangles at more than 45° to its plane, whether they bear grass or not. What counts is the
/// distance of the whole triangle, so that the direction of the ray does not matter at a wall.
class Exposure {
public:
    /// `rayLength` and `footReach`, of the foot of occluders, in [m]; rays see occluders up to
    /// twice that reach. Ground and query must outlive it.
    Exposure(const terrain::GroundMesh& ground, const BakeSettings& settings, double rayLength,
             const terrain::SurfaceQuery& query, double footReach = 0.0);

    /// 1 if there are no rays.
    double at(const RootSample& root) const;

    Surroundings around(const RootSample& root) const;

private:
    struct Direction {
        double cos;
        double sin;
    };

    template <typename Blocked>
    double openShare(const RootSample& root, Blocked blocked) const;
    double footDistance(const RootSample& root, glm::dvec3 direction) const;

    const terrain::GroundMesh& ground_;
    const terrain::SurfaceQuery& query_;
    std::uint64_t seed_;
    double rayLength_;
    double footReach_;
    std::vector<Direction> spiral_; ///< where each ray points, before the root's own turn
};

/// Surroundings of each root, at a blade scale.
std::vector<Surroundings> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                       const BakeSettings& settings, double scale,
                                       const terrain::SurfaceQuery& query, Progress& progress);

} // namespace sward::bake
