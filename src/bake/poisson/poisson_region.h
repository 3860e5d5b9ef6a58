#pragma once

#include "bake/filter/root_filter.h"
#include "bake/ground/root_sample.h"
#include "bake/ground/tile_region.h"
#include "bake/poisson/disk.h"
#include "bake/poisson/poisson_fragments.h"
#include "bake/poisson/poisson_tuning.h"
#include "bake/report.h"
#include "bake/sample/cube_index.h"
#include "bake/sample/search_limit.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::bake {

/// Result of filling a region.
struct RegionResult {
    std::vector<RootSample> roots;
    std::vector<float> radii;        ///< of the roots' disks [m]
    std::vector<std::uint8_t> bears; ///< 0: thinned; it still blocks others
    std::uint64_t thrown = 0;        ///< number of darts, also of those that bare parts save
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
