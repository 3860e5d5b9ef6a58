#pragma once

#include "bake/filter/root_filter.h"
#include "bake/ground/tile_region.h"
#include "bake/plan/plan.h"
#include "bake/sample/surface_sampler.h"
#include "bake/settings/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <memory>
#include <optional>

namespace sward::bake {

/// Roots of a whole ground, sampled while planning.
struct WholeSample {
    const terrain::GroundMesh* ground; ///< whose roots they are
    Sampling sampling;
};

/// How roots are sampled, computed once for a whole ground. Parts sampled with the same plan have
/// the same roots.
struct RootPlan {
    Amount amount;         ///< Poisson disks use its priority, not its density
    double spacing = 0.0;  ///< [m]; 0: uniform
    bool filtered = false; ///< whether any filter tests anything

    /// Poisson disks: area that bears [m²], each part of it times its share of the density; both
    /// sides count if both bear. Estimated from 65536 places (standard error below 0.2 % of all
    /// ground), exact without filters. None in a plan of a file that does not say.
    std::optional<double> bearing;

    /// The roots that a Poisson count was planned from, for the first call of sampleRoots(); null
    /// in a plan that was read.
    std::shared_ptr<WholeSample> sampled;
};

/// Chooses the number of roots. A count of uniform roots takes candidates in order of priority. A
/// count of Poisson disks uses a spacing that yields slightly too many and keeps those of lowest
/// priority. The plan holds these roots. Throws Error{input} with the largest number found if the
/// ground keeps fewer roots. Strokes do not change the plan: the filter must have none.
RootPlan planRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const RootFilter& filter, const Plan& plan, Progress& progress);

/// Samples the roots of a ground, or of a part. Counts only candidates in `counted` (null:
/// everywhere) as proposed or rejected. Roots more than `around` [m] from there, along an axis, may
/// be left out. Strokes thin Poisson disks and add none.
Sampling sampleRoots(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const RootFilter& filter, const RootPlan& plan, Progress& progress,
                     const TileRegion* counted = nullptr, double around = unbounded);

/// Largest distance along each axis of anything that affects a root, except rays [m].
double rootReach(const BakeSettings& settings, const RootPlan& plan);

} // namespace sward::bake
