#pragma once

#include "bake/filter/root_filter.h"
#include "bake/report.h"
#include "bake/root_sample.h"
#include "bake/sample/cube_index.h"
#include "bake/sample/disk.h"
#include "bake/sample/poisson_fragments.h"
#include "bake/sample/search_limit.h"
#include "bake/tile_region.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::bake {

/// Parameters of dart throwing. Lengths are in spacings.
struct PoissonTuning {
    static constexpr int passes = 3;

    /// Longest edge of the triangle parts at which darts are thrown.
    double fragmentEdge = 3.0;
    /// Rounds in each pass. Each pass after the first targets the quarters of those parts that no
    /// single disk covers.
    std::array<int, passes> rounds = {1, 1, 0};
    /// Area per dart in a round of the first pass [spacing²]; a quarter of it in each later pass.
    double areaPerDart = 0.8;
    /// Largest disk, used at low density; below that density, roots are thinned.
    double widest = 4.0;
    /// Two roots whose normals have a lower cosine are on different sheets and do not exclude each
    /// other.
    double sheetCosine = 0.3;
    /// Roots per m² of flat ground at a spacing of 1 m, within 1 %.
    double yield = 0.576;

    /// The default: relative radius ρ ≥ 0.70; at most 1 % of the ground is farther than the spacing
    /// from every root.
    static PoissonTuning fast() { return {}; }
    /// Three times the darts, where needed: ρ ≥ 0.74, at most 0.3 %.
    static PoissonTuning dense()
    {
        return {.fragmentEdge = 2.4, .rounds = {1, 1, 1}, .yield = 0.635};
    }
};

/// The tuning for the spread of the settings.
PoissonTuning tuningOf(const BakeSettings& settings);

/// Result of filling a region.
struct RegionResult {
    std::vector<RootSample> roots;
    std::vector<float> radii;        ///< of the roots' disks [m]
    std::vector<std::uint8_t> bears; ///< 0: thinned; it still blocks others
    std::uint64_t thrown = 0;        ///< number of darts
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// Throws darts at regions. A filler keeps only memory between regions; each thread has its own.
class RegionFiller {
public:
    /// All arguments must outlive the filler. `spacing` [m]; counts darts in `counted` (null: all).
    RegionFiller(const terrain::GroundMesh& ground, std::uint64_t seed, const RootFilter& filter,
                 const PoissonLattice& lattice, double spacing, bool filtered,
                 const PoissonTuning& tuning, const TileRegion* counted);
    ~RegionFiller();

    /// Throws Error{input} in fill() when the limit is over; it must outlive the filler.
    void bound(const SearchLimit& limit);

    /// Fills the region of these pieces, given the disks of all earlier regions.
    RegionResult fill(std::span<const RegionPiece> pieces, const CubeIndex<Disk>& before);

private:
    class Sampler;
    std::unique_ptr<Sampler> sampler_;
};

} // namespace sward::bake
