#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::terrain {

/// Who lies next to whom. Edge e of a triangle runs from corner e to corner e+1.
struct Adjacency {
    static constexpr std::uint32_t none = 0xffffffffU;

    std::vector<glm::uvec3> neighbours;      ///< across each edge; `none` at a border
    std::vector<std::uint8_t> reversedEdges; ///< bit e: the neighbour's front is on the other side
    std::vector<std::uint8_t> crowdedEdges;  ///< bit e: three triangles or more share the edge
    std::vector<std::uint32_t> originalOf; ///< the first triangle of the same corners; often itself
    std::vector<std::uint8_t> collapsed;   ///< 1: two corners are one vertex; no neighbours
    std::uint64_t crowdedEdgeCount = 0;
    std::uint64_t splitVertexCount = 0; ///< vertices where separate fans touch
};

/// Finds the neighbours in `triangles`, whose corners are welded vertices below `vertices`, by a
/// half-edge mesh of OpenMesh. Triangles that it refuses are put in on copied vertices and sewn to
/// their neighbours afterwards. A repeated triangle has the neighbours of the first one.
Adjacency findNeighbours(const std::vector<glm::uvec3>& triangles, std::uint32_t vertices);

} // namespace sward::terrain
