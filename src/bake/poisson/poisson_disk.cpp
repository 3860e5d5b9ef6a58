#include "bake/poisson/poisson_disk.h"

#include "core/bounds.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

// Side of the lattice's cubes in units of the distance between regions.
constexpr double sideInAparts = 16.0;

// Lattice offset [sides]. Avoids the world's origin, because much ground is flat there.
constexpr double latticeOffset = 0.377;

double extentOf(const terrain::GroundMesh& ground)
{
    const Aabb box = ground.bounds();
    double extent = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        extent =
            std::max({extent, std::fabs(double(box.low[axis])), std::fabs(double(box.high[axis]))});
    return extent;
}

// Required distance between regions: the widest disk plus the extent of parts around their centres.
double apartOf(double spacing, bool filtered, const PoissonTuning& tuning)
{
    const double widest = filtered ? tuning.widest : 1.0;
    return spacing * (1.0001 * widest + 2.0 * fromCentroid * tuning.fragmentEdge);
}

PoissonLattice latticeFor(double spacing, bool filtered, const PoissonTuning& tuning, double extent)
{
    const double apart = apartOf(spacing, filtered, tuning);
    return {sideInAparts * apart, latticeOffset * sideInAparts * apart, apart, extent};
}

} // namespace

PoissonDisk::PoissonDisk(const terrain::GroundMesh& ground, const BakeSettings& settings,
                         const RootFilter& filter, double spacing, bool filtered,
                         const PoissonTuning& tuning)
    : ground_(ground)
    , settings_(settings)
    , filter_(filter)
    , spacing_(spacing)
    , filtered_(filtered)
    , tuning_(tuning)
    , lattice_(latticeFor(spacing, filtered, tuning, extentOf(ground)))
{
}

double PoissonDisk::reach(double spacing, bool filtered, const PoissonTuning& tuning)
{
    return latticeFor(spacing, filtered, tuning, 0.0).reach();
}

Sampling PoissonDisk::sample(Progress& progress, const TileRegion* counted,
                             const SearchLimit* limit) const
{
    const std::vector<RegionPiece> pieces =
        piecesByRegion(ground_, settings_.sides, lattice_, tuning_.fragmentEdge * spacing_);
    progress.begin("sample", pieces.size());

    // First piece of each region.
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (i == 0 || pieces[i].region != pieces[i - 1].region)
            first.push_back(i);
    first.push_back(pieces.size());
    const std::size_t regions = first.size() - 1;

    tbb::enumerable_thread_specific<RegionFiller> fillers([&] {
        return RegionFiller(ground_, settings_.seed, filter_, lattice_, spacing_, filtered_,
                            tuning_, counted);
    });
    CubeIndex<Disk> disks(0.5 * lattice_.side());
    Sampling result;
    std::vector<RegionResult> filled(regions);
    for (std::size_t begin = 0; begin < regions;) {
        // All regions of one kind at once.
        const int kind = PoissonLattice::kindOf(pieces[first[begin]].region);
        std::size_t end = begin;
        while (end < regions && PoissonLattice::kindOf(pieces[first[end]].region) == kind)
            ++end;
        tbb::parallel_for(begin, end, [&](std::size_t r) {
            const std::span<const RegionPiece> own(pieces.data() + first[r],
                                                   first[r + 1] - first[r]);
            RegionFiller& filler = fillers.local();
            if (limit != nullptr)
                filler.bound(*limit);
            filled[r] = filler.fill(own, disks);
            progress.advance(own.size());
        });
        if (kind != 3)
            for (std::size_t r = begin; r < end; ++r)
                for (std::size_t i = 0; i < filled[r].roots.size(); ++i) {
                    const RootSample& root = filled[r].roots[i];
                    disks.add({root.position, filled[r].radii[i], root.normal});
                }
        begin = end;
    }

    // Collect the bearing roots, region by region.
    std::vector<std::size_t> place(regions + 1, 0);
    for (std::size_t r = 0; r < regions; ++r) {
        const RegionResult& region = filled[r];
        result.proposed += region.thrown;
        for (std::size_t i = 0; i < rejectCount; ++i)
            result.rejected[i] += region.rejected[i];
        place[r + 1] = place[r] + static_cast<std::size_t>(
                                      std::count(region.bears.begin(), region.bears.end(), 1));
    }
    result.roots.resize(place.back());
    tbb::parallel_for(std::size_t(0), regions, [&](std::size_t r) {
        RegionResult& region = filled[r];
        std::size_t to = place[r];
        for (std::size_t i = 0; i < region.roots.size(); ++i)
            if (region.bears[i] != 0)
                result.roots[to++] = region.roots[i];
        region = {};
    });
    return result;
}

} // namespace sward::bake
