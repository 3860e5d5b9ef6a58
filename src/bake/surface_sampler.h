#pragma once

#include "bake/tile_region.h"
#include "bake/report.h"
#include "bake/root_filter.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Roots that were kept, in the order of triangle and candidate, and what became of the others.
struct Sampling {
    Roots roots;
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// How many candidates there are, and which of them count: those of at most this priority; of equal
/// priority, those of at most this key.
struct Amount {
    double density = 0.0;  ///< [1/m²] of candidates
    double priority = 1.0; ///< [0, 1]; 1: all
    std::uint64_t lastKey = 0;

    bool takesAll() const { return priority >= 1.0; }
};

/// Area-weighted uniform sampling, stratified. A triangle of area A gets ⌊λA + u⌋ candidates, u
/// uniform per triangle and stratified over neighbours: λA in expectation, whatever the other
/// triangles are. A candidate's place, and all else about it, is a function of (seed, triangle,
/// candidate), so more density adds candidates and moves none.
class SurfaceSampler {
public:
    /// All must outlive the sampler.
    SurfaceSampler(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const RootFilter& filter);

    /// Tries the candidates of an amount and keeps what passes the filter. Only candidates in
    /// `counted` (null: everywhere) count as proposed and rejected.
    Sampling sample(const Amount& amount, Progress& progress,
                    const TileRegion* counted = nullptr) const;

    /// The amount by which exactly `count` roots are kept, or, if the ground does not keep so many,
    /// all that can be found (then the priority is 1): the candidates of lowest priority that pass.
    Amount amountFor(std::uint64_t count, Progress& progress) const;

private:
    struct Block;
    struct Tries;

    std::vector<std::uint64_t> firstCandidates(double density) const;
    std::uint32_t candidates(std::size_t triangle, double density, bool back) const;
    bool takes(const RootSample& root, const Amount& amount, bool counts, Block& block) const;
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
