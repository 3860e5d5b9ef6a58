#pragma once

#include "bake/filter/root_filter.h"
#include "bake/poisson/poisson_region.h"
#include "bake/sample/surface_sampler.h"
#include "bake/settings/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Poisson-disk sampling by dart throwing. No two roots of one sheet are nearer than the spacing
/// (Euclidean, in single-precision positions), and almost no gap is left where another would fit.
/// Regions of a lattice are filled kind after kind, all of one kind in parallel. A root depends
/// only on the surroundings within reach(), not on the number of threads or the part of the ground.
/// (Dart throwing: Cook 1986; independent regions: Wei 2008 and Bowers et al. 2010; skipping parts
/// covered by one disk: Cline et al. 2009. docs/algorithms/sampling.md)
class PoissonDisk {
public:
    /// All arguments must outlive the sampler. `spacing` [m] > 0. `filtered`: whether the filter
    /// tests anything on the whole ground; disks may then be wider than the spacing.
    PoissonDisk(const terrain::GroundMesh& ground, const BakeSettings& settings,
                const RootFilter& filter, double spacing, bool filtered,
                const PoissonTuning& tuning = {});

    /// All roots, sorted by triangle and candidate. `proposed` counts the darts. Darts at parts
    /// that a disk covers are never thrown or counted; those at parts where the filter lets nothing
    /// grow are counted by its reason, but not thrown. Counts only darts in `counted` (null:
    /// everywhere). Throws Error{input} when `limit` is over (null: none).
    Sampling sample(Progress& progress, const TileRegion* counted = nullptr,
                    const SearchLimit* limit = nullptr) const;

    /// Largest distance along each axis of anything that affects a root [m].
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
