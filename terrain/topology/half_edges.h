#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::terrain {

/// Adjacency of triangles. Edge e of a triangle runs from corner e to corner e+1.
struct Adjacency {
    static constexpr std::uint32_t none = 0xffffffffU;

    std::vector<glm::uvec3> neighbours;      ///< across each edge; `none` at a border
    std::vector<std::uint8_t> reversedEdges; ///< bit e: the neighbour faces the other way
    std::vector<std::uint8_t> crowdedEdges;  ///< bit e: three triangles or more share the edge
    std::vector<std::uint32_t> originalOf; ///< the first triangle of the same corners; often itself
    std::vector<std::uint8_t> collapsed;   ///< 1: two corners are one vertex; no neighbours
    std::uint64_t crowdedEdgeCount = 0;
    std::uint64_t splitVertexCount = 0; ///< vertices where separate fans touch
};

/// Finds the neighbours of `triangles`, whose corners are welded vertices below `vertices`, by a
/// half-edge mesh of OpenMesh. Rejected triangles are added on duplicate vertices and connected
/// afterwards. A repeated triangle gets the neighbours of the first one.
Adjacency findNeighbours(const std::vector<glm::uvec3>& triangles, std::uint32_t vertices);

} // namespace sward::terrain
