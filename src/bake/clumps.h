#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sward::bake {

/// Grass grows in tufts: points scattered over the ground, each the middle of a clump to which the
/// nearest blades belong (a Voronoi diagram on the surface). Where they lie depends on triangles,
/// as roots do, so clumps turn with the mesh.
class Clumps {
public:
    struct Clump {
        glm::vec3 centre{0.0f}; ///< [m] relative to the ground's origin
        std::uint64_t key = 0;  ///< for the clump's own random numbers
    };

    /// Clumps about `size` [m] apart; none if `size` is 0.
    Clumps(const terrain::GroundMesh& ground, double size, std::uint64_t seed);

    /// The clump nearest to a place, or null if none is within one and a half times the size.
    const Clump* nearest(glm::vec3 place) const;

private:
    std::uint64_t cellOf(glm::ivec3 cell) const;

    double cellSize_ = 0.0;
    std::vector<Clump> clumps_; ///< sorted by cell
    std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;
};

} // namespace sward::bake
