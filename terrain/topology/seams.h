#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/topology/half_edges.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace sward::terrain {

/// Numbers vertices of open edges alike that are no farther apart than GroundMesh::precision and a
/// twentieth of the shortest open edge at both: corners of tiles that were meant to be one. Changes
/// `weldOf` and `count` (see weld()), whose numbers are of first appearance again. `triangles` and
/// `adjacency` are those of the old numbers. Returns how many numbers have gone.
std::uint64_t weldSeams(const GroundMesh& mesh, const std::vector<glm::uvec3>& triangles,
                        const Adjacency& adjacency, std::vector<std::uint32_t>& weldOf,
                        std::uint32_t& count);

/// Open edges that others cover all along, with T-junctions between them.
struct TJunctions {
    std::vector<std::uint8_t> edges; ///< bit e of each triangle; empty: none
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours; ///< triangles
    std::uint64_t count = 0;                                         ///< edges
};

/// Finds them, within the same distance. `triangles` are of welded vertices.
TJunctions findTJunctions(const GroundMesh& mesh, const std::vector<glm::uvec3>& triangles,
                          const Adjacency& adjacency, const std::vector<std::uint32_t>& weldOf,
                          std::uint32_t count);

} // namespace sward::terrain
