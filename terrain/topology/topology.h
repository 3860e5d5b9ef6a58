#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::terrain {

/// Connections between triangles. Computed on a half-edge mesh (OpenMesh) with vertices of equal
/// position merged, and those of open edges within GroundMesh::precision (weldSeams()); the
/// GroundMesh itself stays a soup.
struct Topology {
    std::vector<std::uint32_t> weldOf; ///< per vertex: index of its welded vertex
    std::uint32_t weldedVertices = 0;
    std::vector<std::uint32_t>
        componentOf; ///< per triangle: connected piece, numbered by first triangle
    std::uint32_t components = 0;

    std::vector<std::uint32_t> originalOf; ///< per triangle: first one of its corners; often itself

    /// Per triangle, bit e: the edge from corner e to corner e+1 …
    std::vector<std::uint8_t> borderEdges; ///< … has no neighbour
    std::vector<std::uint8_t> seamEdges;   ///< … has none of its own, but others lie along it
                                           ///< (T-junctions); empty: none
    std::vector<std::uint8_t>
        creaseEdges; ///< … cannot share a normal: it turns by more than the crease
                     ///< angle, has three triangles, or two fronts that disagree
    std::vector<std::uint8_t> brokenEdges; ///< … has three triangles, or two fronts that disagree

    std::uint64_t borderEdgeCount = 0; ///< without seamEdges
    std::uint64_t seamVertexCount = 0; ///< vertices merged at a distance
    std::uint64_t seamEdgeCount = 0;   ///< of seamEdges
    std::uint64_t creaseEdgeCount = 0;
    std::uint64_t nonManifoldEdgeCount = 0;   ///< edges of three triangles or more
    std::uint64_t nonManifoldVertexCount = 0; ///< vertices where separate fans touch
    std::uint64_t degenerateTriangles = 0;    ///< no area, or two corners welded
    std::uint64_t duplicateTriangles = 0;     ///< same three welded corners as an earlier one
};

/// Whether seamEdges are searched; normals do not need them.
enum class Seams { withTJunctions, withoutTJunctions };

/// Analyses the connections. `creaseAngle` [rad]: neighbours whose face normals differ by more do
/// not share a normal.
Topology analyse(const GroundMesh& mesh, double creaseAngle = 0.7853981633974483,
                 Seams seams = Seams::withTJunctions);

/// Angle-weighted vertex normals (Thürmer & Wüthrich 1998), not smoothed across creases; a vertex
/// on a crease is split. Replaces the normals of `mesh` and may append vertices.
void computeNormals(GroundMesh& mesh, const Topology& topology);

} // namespace sward::terrain
