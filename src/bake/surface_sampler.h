#pragma once

#include "bake/report.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Roots that were kept, in the order of triangle and candidate, and what became of the others.
struct Sampling {
    std::vector<RootSample> roots;
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// Area-weighted uniform sampling. A triangle of area A gets ⌊λA + u⌋ candidates, u uniform per
/// triangle: λA in expectation, whatever the other triangles are. A candidate's place, and all else
/// about it, is a function of (seed, triangle, candidate), so more density adds candidates and
/// moves none.
class SurfaceSampler {
public:
    /// All must outlive the sampler. `query` may be null if no setting asks for rays.
    SurfaceSampler(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   const terrain::SurfaceQuery* query);

    /// Area that may bear grass, both sides counted if both bear [m²].
    double area() const { return area_; }

    /// Samples with `density` [1/m²] and keeps what passes mask, slope, altitude and clearance.
    Sampling sample(double density, Progress& progress) const;

    /// Exactly `count` roots, or all that could be found if the ground does not keep so many: the
    /// candidates of lowest priority that pass. `proposed` and `rejected` count candidates up to
    /// that priority (to 1/512).
    Sampling sampleCount(std::uint64_t count, Progress& progress) const;

private:
    struct Block;

    std::uint32_t candidates(std::size_t triangle, double density, bool back) const;
    void propose(std::size_t triangle, std::uint32_t candidate, Block& block) const;
    bool passes(const RootSample& root, Block& block) const;
    std::vector<std::uint64_t> firstCandidates(double density) const;
    std::vector<Block> run(double density, Progress& progress) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const terrain::SurfaceQuery* query_;
    double area_ = 0.0;
};

/// Priority of a root in [0, 1): the order in which a count takes candidates.
double priorityOf(std::uint64_t seed, field::BladeKey key);

/// Unit normal of the surface at barycentrics (b, c) of a triangle: the interpolated vertex normal,
/// or the face's own where that points to the other side.
glm::dvec3 surfaceNormal(const terrain::GroundMesh& ground, std::size_t triangle, double b,
                         double c);

} // namespace sward::bake
