#include "terrain/topology/topology.h"

#include "core/math/exact_math.h"
#include "terrain/topology/half_edges.h"
#include "terrain/topology/seams.h"
#include "terrain/topology/weld.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <numeric>
#include <utility>

namespace sward::terrain {
namespace {

// Disjoint sets of triangles; the lowest member names a set.
class Pieces {
public:
    explicit Pieces(std::size_t count)
        : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    std::uint32_t find(std::uint32_t i)
    {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b)
    {
        a = find(a);
        b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

private:
    std::vector<std::uint32_t> parent_;
};

// Joins collapsed triangles with the triangles they touch.
void joinCollapsed(const std::vector<glm::uvec3>& triangles, const Adjacency& adjacency,
                   std::uint32_t vertices, Pieces& pieces)
{
    std::vector<std::uint32_t> touching(vertices, Adjacency::none);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (adjacency.collapsed[i] == 0 && touching[triangles[i][corner]] == Adjacency::none)
                touching[triangles[i][corner]] = i;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            std::uint32_t& other = touching[triangles[i][corner]];
            if (adjacency.collapsed[i] == 0)
                continue;
            if (other == Adjacency::none)
                other = i;
            pieces.join(i, other);
        }
}

void findComponents(const std::vector<glm::uvec3>& triangles, const Adjacency& adjacency,
                    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& further,
                    Topology& topology)
{
    Pieces pieces(triangles.size());
    bool someCollapsed = false;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (glm::length_t e = 0; e < 3; ++e)
            if (adjacency.neighbours[i][e] != Adjacency::none)
                pieces.join(i, adjacency.neighbours[i][e]);
        pieces.join(i, adjacency.originalOf[i]);
        someCollapsed = someCollapsed || adjacency.collapsed[i] != 0;
    }
    for (const auto& [one, other] : further)
        pieces.join(one, other);
    if (someCollapsed)
        joinCollapsed(triangles, adjacency, topology.weldedVertices, pieces);

    // The lowest member is visited first, so numbers follow first appearance.
    topology.componentOf.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t first = pieces.find(i);
        topology.componentOf[i] = first == i ? topology.components++ : topology.componentOf[first];
    }
}

std::vector<glm::dvec3> faceNormals(const GroundMesh& mesh)
{
    std::vector<glm::dvec3> normals(mesh.triangles.size());
    tbb::parallel_for(std::size_t(0), normals.size(),
                      [&](std::size_t i) { normals[i] = mesh.faceNormal(i); });
    return normals;
}

} // namespace

Topology analyse(const GroundMesh& mesh, double creaseAngle, Seams seams)
{
    Topology topology;
    topology.weldOf = weld(mesh.positions, topology.weldedVertices);
    std::vector<glm::uvec3> triangles = mesh.triangles;
    for (glm::uvec3& t : triangles)
        t = {topology.weldOf[t.x], topology.weldOf[t.y], topology.weldOf[t.z]};

    Adjacency adjacency = findNeighbours(triangles, topology.weldedVertices);
    topology.seamVertexCount =
        weldSeams(mesh, triangles, adjacency, topology.weldOf, topology.weldedVertices);
    if (topology.seamVertexCount > 0) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            triangles[i] = {topology.weldOf[t.x], topology.weldOf[t.y], topology.weldOf[t.z]};
        }
        adjacency = findNeighbours(triangles, topology.weldedVertices);
    }
    TJunctions junctions;
    if (seams == Seams::withTJunctions)
        junctions =
            findTJunctions(mesh, triangles, adjacency, topology.weldOf, topology.weldedVertices);
    topology.seamEdgeCount = junctions.count;
    topology.seamEdges = std::move(junctions.edges);
    topology.nonManifoldEdgeCount = adjacency.crowdedEdgeCount;
    topology.nonManifoldVertexCount = adjacency.splitVertexCount;
    topology.creaseEdgeCount = adjacency.crowdedEdgeCount;
    findComponents(triangles, adjacency, junctions.neighbours, topology);

    const std::vector<glm::dvec3> normals = faceNormals(mesh);
    const double smoothest = exactSinCos(creaseAngle).cos;
    topology.borderEdges.assign(triangles.size(), 0);
    topology.creaseEdges.assign(triangles.size(), 0);
    topology.brokenEdges.assign(triangles.size(), 0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (adjacency.collapsed[i] != 0 || normals[i] == glm::dvec3(0.0))
            ++topology.degenerateTriangles;
        if (adjacency.collapsed[i] != 0)
            continue;
        const bool repeated = adjacency.originalOf[i] != i;
        topology.duplicateTriangles += repeated ? 1U : 0U;
        for (glm::length_t e = 0; e < 3; ++e) {
            const auto bit = static_cast<std::uint8_t>(1U << e);
            const std::uint32_t other = adjacency.neighbours[i][e];
            if (other == Adjacency::none) {
                topology.borderEdges[i] |= bit;
                const bool isSeam =
                    !topology.seamEdges.empty() && (topology.seamEdges[i] & bit) != 0;
                topology.borderEdgeCount += repeated || isSeam ? 0U : 1U;
                continue;
            }
            // A repeated triangle shares no normal with its original or its neighbours.
            const bool crowded = (adjacency.crowdedEdges[i] & bit) != 0;
            const bool reversed = (adjacency.reversedEdges[i] & bit) != 0;
            const double turn = glm::dot(normals[i], normals[other]);
            const bool bends = normals[i] != glm::dvec3(0.0) && normals[other] != glm::dvec3(0.0) &&
                               turn < smoothest;
            if (crowded || reversed || bends || repeated)
                topology.creaseEdges[i] |= bit;
            if (crowded || reversed)
                topology.brokenEdges[i] |= bit;
            // Both triangles visit the edge; count it once.
            if ((reversed || bends) && !crowded && !repeated && i < other)
                ++topology.creaseEdgeCount;
        }
    }
    topology.originalOf = std::move(adjacency.originalOf);
    return topology;
}

} // namespace sward::terrain
