#pragma once

#include "bake/cube_index.h"
#include "bake/disk.h"
#include "bake/poisson_fragments.h"
#include "bake/tile_region.h"
#include "bake/report.h"
#include "bake/root_filter.h"
#include "bake/root_sample.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::bake {

/// How darts are thrown. Lengths are in spacings.
struct PoissonTuning {
    static constexpr int passes = 3;

    /// Darts are thrown at parts of triangles with edges of at most so much …
    double fragmentEdge = 3.0;
    /// … in passes of so many rounds; each pass after the first at the quarters of those parts that
    /// no single disk covers.
    std::array<int, passes> rounds = {1, 1, 0};
    /// Area per dart in a round of the first pass [spacing²]; a quarter of it in each pass after.
    double areaPerDart = 0.8;
    /// Largest disk, where least density is wanted; where less is wanted still, roots are thinned.
    double widest = 4.0;
    /// Roots whose normals enclose an angle of less cosine stand on different sheets and do not
    /// keep each other away.
    double sheetCosine = 0.3;
    /// Roots per m² of flat ground at a spacing of 1 m that this yields, within 1 %.
    double yield = 0.576;

    /// The default: relative radius ρ ≥ 0.70, at most 1 % of the ground farther than the spacing
    /// from every root.
    static PoissonTuning fast() { return {}; }
    /// Three times the darts, where they are needed: ρ ≥ 0.74, at most 0.3 %.
    static PoissonTuning dense()
    {
        return {.fragmentEdge = 2.4, .rounds = {1, 1, 1}, .yield = 0.635};
    }
};

/// The tuning for a spread of roots.
PoissonTuning tuningOf(const BakeSettings& settings);

/// What became of a region.
struct RegionResult {
    std::vector<RootSample> roots;
    std::vector<float> radii;        ///< of the roots' disks [m]
    std::vector<std::uint8_t> bears; ///< 0: thinned; it keeps its place, but bears nothing
    std::uint64_t thrown = 0;        ///< darts
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// Throws darts at regions. What a filler keeps from one region to the next is memory alone; each
/// thread has its own.
class RegionFiller {
public:
    /// All must outlive the filler. `spacing` [m]; darts in `counted` (null: all) are counted.
    RegionFiller(const terrain::GroundMesh& ground, std::uint64_t seed, const RootFilter& filter,
                 const PoissonLattice& lattice, double spacing, bool filtered,
                 const PoissonTuning& tuning, const TileRegion* counted);
    ~RegionFiller();

    /// Fills the region of these pieces, given the disks of the regions that come before.
    RegionResult fill(std::span<const RegionPiece> pieces, const CubeIndex<Disk>& before);

private:
    class Sampler;
    std::unique_ptr<Sampler> sampler_;
};

} // namespace sward::bake
