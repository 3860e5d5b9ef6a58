#pragma once

#include "bake/ground/root_sample.h"
#include "core/uninitialized.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// Clumps of grass: centres scattered over the ground. Each blade belongs to the nearest centre (a
/// Voronoi diagram on the surface). A centre depends only on seed, spacing and its own triangle,
/// like a root. So clumps move with the mesh, and a part of the ground with a halo of reach() has
/// the same clumps as the whole.
class Clumps {
public:
    struct Clump {
        glm::vec3 centre;       ///< [m] relative to the ground's origin
        std::uint32_t triangle; ///< triangle of the centre
        std::uint64_t key;      ///< key of the clump's random numbers

        /// Shared facing of the clump: unit vector along its triangle.
        glm::dvec3 direction(const terrain::GroundMesh& ground) const;
    };

    /// Makes clumps about `spacing` [m] apart, from clumpSpacing(); none if it is 0.
    Clumps(const terrain::GroundMesh& ground, double spacing, std::uint64_t seed);

    /// The clump nearest to a position, or null if none is within reach().
    const Clump* nearest(glm::vec3 place) const;

    /// The same for several roots, as many as `found` has room for. Fast if they lie near each
    /// other.
    void nearest(std::span<const RootSample> roots, std::span<const Clump*> found) const;

    /// Typical distance of clumps [m].
    double spacing() const { return spacing_; }

    /// Largest distance of a blade from its clump [m].
    double reach() const { return reach_; }

    std::size_t size() const { return clumps_.size(); }

    /// A clump by its place in memory, which differs from run to run, and that place.
    const Clump& operator[](std::size_t index) const { return clumps_[index]; }
    std::size_t indexOf(const Clump& clump) const
    {
        return static_cast<std::size_t>(&clump - clumps_.data());
    }

private:
    void scatter(const terrain::GroundMesh& ground, double spacing, std::uint64_t key);
    void sortIntoBuckets();
    std::size_t bucketOf(glm::ivec3 cell) const;
    void nearestOfFew(std::span<const RootSample> roots, std::span<const Clump*> found) const;

    double spacing_ = 0.0;
    double reach_ = 0.0;
    UninitializedVector<Clump> clumps_; ///< by bucket, unordered inside
    std::vector<std::uint32_t> first_;  ///< beginning of each bucket, and the end
};

/// Spacing for clumps of typical distance `size` [m] on bearing ground of `area` [m²]. Larger than
/// `size` if there would be more than two million clumps. Compute it once for the whole ground.
double clumpSpacing(double size, double area);

/// Key of the centres' random numbers. The centre `i` of a triangle has the key
/// hashBits(clumpKeyOf(seed), triangle << 32 | i), with the triangle's number in the input.
std::uint64_t clumpKeyOf(std::uint64_t seed);

} // namespace sward::bake
