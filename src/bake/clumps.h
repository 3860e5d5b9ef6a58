#pragma once

#include "core/uninitialized.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Grass grows in clumps: points scattered over the ground, each the middle of a clump to which the
/// nearest blades belong (a Voronoi diagram on the surface). A centre is a function of seed,
/// spacing and its own triangle, as a root is: clumps turn with the mesh, and a part of the ground
/// with a halo of reach() has those of the whole.
class Clumps {
public:
    struct Clump {
        glm::vec3 centre;       ///< [m] relative to the ground's origin
        std::uint32_t triangle; ///< that it lies on
        std::uint64_t key;      ///< for the clump's own random numbers

        /// Unit vector along its triangle: where the whole clump looks.
        glm::dvec3 direction(const terrain::GroundMesh& ground) const;
    };

    /// Clumps about `spacing` [m] apart, from clumpSpacing(); none if it is 0.
    Clumps(const terrain::GroundMesh& ground, double spacing, std::uint64_t seed);

    /// The clump nearest to a place, or null if none is within reach().
    const Clump* nearest(glm::vec3 place) const;

    /// How far a blade's clump may be [m].
    double reach() const { return reach_; }

    std::size_t size() const { return clumps_.size(); }

private:
    void scatter(const terrain::GroundMesh& ground, double spacing, std::uint64_t key);
    void sortIntoBuckets();
    std::size_t bucketOf(glm::ivec3 cell) const;

    double reach_ = 0.0;
    UninitializedVector<Clump> clumps_; ///< by bucket, in any order inside
    std::vector<std::uint32_t> first_;  ///< where each bucket begins, and the end
};

/// Spacing of clumps of typical distance `size` [m] on ground of `area` [m²] that bears: larger
/// than asked where there would be more than two million. One number for the whole ground.
double clumpSpacing(double size, double area);

} // namespace sward::bake
