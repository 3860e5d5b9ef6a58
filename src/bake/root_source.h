#pragma once

#include "bake/plan.h"
#include "bake/tile_region.h"
#include "bake/root_filter.h"
#include "bake/settings.h"
#include "bake/surface_sampler.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// How roots are found, settled once for a whole ground; parts of it are then sampled with the same
/// numbers and have the same roots.
struct RootPlan {
    Amount amount;         ///< priorities hold for Poisson disks too, densities do not
    double spacing = 0.0;  ///< [m]; 0: uniform
    bool filtered = false; ///< whether some filter asks something somewhere
};

/// Settles how many roots there are. A count of uniform roots is met by taking candidates in order
/// of priority; a count of Poisson disks by a spacing that yields a few too many, of which those of
/// highest priority are left out. Throws Error{input} with the largest number that was found where
/// the ground does not keep so many.
RootPlan planRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const RootFilter& filter, const Plan& plan, Progress& progress);

/// The roots of a ground, or of a part. Only candidates in `counted` (null: everywhere) are counted
/// as proposed or rejected.
Sampling sampleRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const RootFilter& filter, const RootPlan& plan, Progress& progress,
                     const TileRegion* counted = nullptr);

/// The farthest along each axis that anything lies which a root depends on, rays apart [m].
double rootReach(const BakeSettings& settings, const RootPlan& plan);

} // namespace sward::bake
