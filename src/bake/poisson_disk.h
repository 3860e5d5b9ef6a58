#pragma once

#include "bake/poisson_region.h"
#include "bake/root_filter.h"
#include "bake/settings.h"
#include "bake/surface_sampler.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Poisson-disk sampling by dart throwing: no two roots of one sheet are nearer than the spacing
/// (Euclidean, in single-precision places), and hardly a place is left where another would fit.
/// Regions of a lattice are filled kind after kind, all of one kind at once; what is decided at a
/// place depends on nothing farther than reach(), whatever the number of threads or the part of the
/// ground at hand. (Dart throwing: Cook 1986; by independent regions: Wei 2008 and Bowers et al.
/// 2010; parts that one disk covers are skipped: Cline et al. 2009. docs/algorithms/sampling.md)
class PoissonDisk {
public:
    /// All must outlive the sampler. `spacing` [m] > 0. `filtered`: whether the filter asks
    /// anything anywhere on the whole ground; disks may then be wider than the spacing.
    PoissonDisk(const terrain::GroundMesh& ground, const BakeSettings& settings,
                const RootFilter& filter, double spacing, bool filtered,
                const PoissonTuning& tuning = {});

    /// All roots, sorted by triangle and candidate. `proposed` are the darts thrown; some that are
    /// bound to be rejected are never thrown. Only those in `counted` (null: everywhere) count.
    Sampling sample(Progress& progress, const TileRegion* counted = nullptr) const;

    /// Along each axis, the farthest that anything lies which a root depends on [m].
    static double reach(double spacing, bool filtered, const PoissonTuning& tuning);

private:
    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const RootFilter& filter_;
    double spacing_;
    bool filtered_;
    PoissonTuning tuning_;
    PoissonLattice lattice_;
};

} // namespace sward::bake
