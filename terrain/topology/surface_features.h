#pragma once

#include "core/bounds.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/convex_creases.h"
#include "terrain/topology/topology.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::terrain {

/// Properties derived from the connections of the whole ground. Computed once and copied to any
/// part of the ground (partOf), so that a part gives the same results as the whole.
struct SurfaceFeatures {
    /// An edge with one triangle, relative to the ground's origin [m].
    struct BorderEdge {
        glm::vec3 from{0.0f};
        glm::vec3 to{0.0f};
    };

    std::vector<float> curvature;      ///< per vertex, meanCurvature(); empty: not requested
    std::vector<float> islandArea;     ///< [m²] per triangle: of its connected piece; may be empty
    std::vector<BorderEdge> borders;   ///< of bearing triangles; empty: none or not requested
    std::vector<BorderEdge> bareEdges; ///< see bareEdges(); empty: none or not requested

    std::vector<ConvexCrease> creases; ///< see convexCreases(); empty: none or not requested

    std::uint64_t seamVertices = 0; ///< of the whole ground: Topology::seamVertexCount
    std::uint64_t seamEdges = 0;    ///< of the whole ground: Topology::seamEdgeCount
};

/// Selects features.
struct FeatureChoice {
    bool curvature = false;
    bool islands = false;
    bool borders = false;

    bool any() const { return curvature || islands || borders; }
};

SurfaceFeatures findFeatures(const GroundMesh& mesh, const Topology& topology,
                             const FeatureChoice& choice);

/// Mean curvature (κ₁ + κ₂)/2 at every vertex [1/m]: positive where the front is convex, 1/R on a
/// sphere of radius R seen from outside, for any triangulation. Mean of the curvatures 2 n·(p −
/// q)/|p − q|² along the edges pq of a vertex p, weighted by the cotangent formula (Meyer et al.
/// 2003) without its negative weights, n by Max 1999. Where it is undefined (a border, an edge of
/// three triangles, inconsistent fronts), the mean of the neighbours.
std::vector<float> meanCurvature(const GroundMesh& mesh, const Topology& topology);

/// Edges of bearing triangles beyond which a triangle goes on about level, within 45°, and bears
/// nothing: the sides of paths, not of walls and cliffs. Vertices of equal position count as one.
std::vector<SurfaceFeatures::BorderEdge> bareEdges(const GroundMesh& mesh);

/// Extracts the features of a part with these vertices and triangles of the whole, in this order.
/// Keeps edges within `reach` [m] of `box`, which holds the part's roots (relative to the shared
/// origin).
SurfaceFeatures partOf(const SurfaceFeatures& whole, std::span<const std::uint32_t> vertices,
                       std::span<const std::uint32_t> triangles, const Aabb& box, double reach);

} // namespace sward::terrain
