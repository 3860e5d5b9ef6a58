#pragma once

#include "bake/filter/root_filter.h"
#include "bake/ground/root_sample.h"
#include "bake/ground/tile_region.h"
#include "bake/report.h"
#include "bake/settings/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Kept roots, in order of triangle and candidate, and the counts of the others.
struct Sampling {
    Roots roots;
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// Number of candidates, and the last one that counts: candidates of lower priority value, or of
/// equal priority and at most this key.
struct Amount {
    double density = 0.0;  ///< [1/m²] of candidates
    double priority = 1.0; ///< [0, 1]; 1: all
    std::uint64_t lastKey = 0;

    bool takesAll() const { return priority >= 1.0; }
};

/// Area-weighted uniform sampling, stratified. A triangle of area A gets ⌊λA + u⌋ candidates, with
/// u uniform per triangle and stratified over neighbours. Their expected number is λA, independent
/// of other triangles. A candidate is a function of (seed, triangle, candidate), so a higher
/// density adds candidates and moves none.
///
/// Where strokes raise the density above 1, triangles get more candidates. The first that a
/// density of d times the bake's would add is kept if the density painted at its place is d or
/// more.
class SurfaceSampler {
public:
    /// All arguments must outlive the sampler.
    SurfaceSampler(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const RootFilter& filter);

    /// Tests the candidates of an amount and keeps those that pass the filter. Only candidates in
    /// `counted` (null: everywhere) count as proposed and rejected. Roots more than `around` [m]
    /// from there, along an axis, may be left out.
    Sampling sample(const Amount& amount, Progress& progress, const TileRegion* counted = nullptr,
                    double around = unbounded) const;

    /// The amount that keeps exactly `count` roots: the passing candidates of lowest priority. If
    /// the ground keeps fewer, all that can be found; the priority is then 1. The filter must have
    /// no strokes.
    Amount amountFor(std::uint64_t count, Progress& progress) const;

private:
    struct Block;
    struct Tries;

    std::vector<std::uint64_t> firstCandidates(double density, const TileRegion* counted = nullptr,
                                               double around = unbounded) const;
    std::uint32_t candidates(std::size_t triangle, double density, bool back) const;
    bool takes(const RootSample& root, const Amount& amount, bool counts, Block& block) const;
    bool takesMore(const RootSample& root, const Amount& amount, bool counts, Block& block) const;
    bool hasPriority(const RootSample& root, const Amount& amount) const;
    bool isFree(const RootSample& root, bool counts, Block& block) const;
    template <typename Visit>
    void forEachBlock(const Tries& tries, Progress& progress, Visit visit) const;
    template <typename Visit>
    void forEachCandidate(const Tries& tries, std::uint64_t begin, std::uint64_t end,
                          Visit visit) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const RootFilter& filter_;
};

/// Area that may bear grass, both sides counted if both bear [m²].
double bearingArea(const terrain::GroundMesh& ground, Sides sides);

/// Priority of a root in [0, 1): the order in which a count takes candidates.
double priorityOf(std::uint64_t seed, field::BladeKey key);

} // namespace sward::bake
