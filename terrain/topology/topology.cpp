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

// The triangles' corners as welded vertices.
std::vector<glm::uvec3> weldedTriangles(const GroundMesh& mesh, const Topology& topology)
{
    std::vector<glm::uvec3> triangles = mesh.triangles;
    for (glm::uvec3& t : triangles)
        t = {topology.weldOf[t.x], topology.weldOf[t.y], topology.weldOf[t.z]};
    return triangles;
}

// Marks and counts borders, creases and broken edges.
class EdgeMarker {
public:
    // All must outlive it. Triangles that meet at a smaller cosine than `smoothest` make a crease.
    EdgeMarker(const Adjacency& adjacency, const std::vector<glm::dvec3>& normals, double smoothest,
               Topology& topology)
        : adjacency_(adjacency)
        , normals_(normals)
        , smoothest_(smoothest)
        , topology_(topology)
    {
        topology.borderEdges.assign(normals.size(), 0);
        topology.creaseEdges.assign(normals.size(), 0);
        topology.brokenEdges.assign(normals.size(), 0);
    }

    void mark(std::uint32_t i)
    {
        const bool isCollapsed = adjacency_.collapsed[i] != 0;
        topology_.degenerateTriangles += isCollapsed || !hasNormal(i) ? 1U : 0U;
        if (isCollapsed)
            return;
        topology_.duplicateTriangles += isRepeated(i) ? 1U : 0U;
        for (glm::length_t e = 0; e < 3; ++e) {
            if (adjacency_.neighbours[i][e] == Adjacency::none)
                markBorder(i, e);
            else
                markCrease(i, e);
        }
    }

private:
    static std::uint8_t bitOf(glm::length_t edge) { return static_cast<std::uint8_t>(1U << edge); }
    bool hasNormal(std::uint32_t i) const { return normals_[i] != glm::dvec3(0.0); }
    bool isRepeated(std::uint32_t i) const { return adjacency_.originalOf[i] != i; }

    void markBorder(std::uint32_t i, glm::length_t e)
    {
        topology_.borderEdges[i] |= bitOf(e);
        const bool isSeam =
            !topology_.seamEdges.empty() && (topology_.seamEdges[i] & bitOf(e)) != 0;
        topology_.borderEdgeCount += isRepeated(i) || isSeam ? 0U : 1U;
    }

    void markCrease(std::uint32_t i, glm::length_t e)
    {
        const std::uint32_t other = adjacency_.neighbours[i][e];
        const bool crowded = (adjacency_.crowdedEdges[i] & bitOf(e)) != 0;
        const bool reversed = (adjacency_.reversedEdges[i] & bitOf(e)) != 0;
        const bool bends =
            hasNormal(i) && hasNormal(other) && glm::dot(normals_[i], normals_[other]) < smoothest_;
        // A repeated triangle shares no normal with its original or its neighbours.
        const bool repeated = isRepeated(i);
        if (crowded || reversed || bends || repeated)
            topology_.creaseEdges[i] |= bitOf(e);
        if (crowded || reversed)
            topology_.brokenEdges[i] |= bitOf(e);
        // Both triangles visit the edge; count it once.
        if ((reversed || bends) && !crowded && !repeated && i < other)
            ++topology_.creaseEdgeCount;
    }

    const Adjacency& adjacency_;
    const std::vector<glm::dvec3>& normals_;
    double smoothest_;
    Topology& topology_;
};

} // namespace

Topology analyse(const GroundMesh& mesh, double creaseAngle, Seams seams)
{
    Topology topology;
    topology.weldOf = weld(mesh.positions, topology.weldedVertices);
    std::vector<glm::uvec3> triangles = weldedTriangles(mesh, topology);
    Adjacency adjacency = findNeighbours(triangles, topology.weldedVertices);
    topology.seamVertexCount =
        weldSeams(mesh, triangles, adjacency, topology.weldOf, topology.weldedVertices);
    if (topology.seamVertexCount > 0) {
        triangles = weldedTriangles(mesh, topology);
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
    EdgeMarker marker(adjacency, normals, exactSinCos(creaseAngle).cos, topology);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        marker.mark(i);
    topology.originalOf = std::move(adjacency.originalOf);
    return topology;
}

} // namespace sward::terrain
