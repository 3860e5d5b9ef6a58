#include "terrain/topology/surface_features.h"

#include "terrain/topology/weld.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace sward::terrain {
namespace {

std::vector<float> islandAreas(const GroundMesh& mesh, const Topology& topology)
{
    std::vector<double> areas(topology.components, 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        areas[topology.componentOf[t]] += mesh.area(t);
    std::vector<float> result(mesh.triangles.size());
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t t) {
        result[t] = static_cast<float>(areas[topology.componentOf[t]]);
    });
    return result;
}

std::uint8_t seamsOf(const Topology& topology, std::size_t triangle)
{
    return topology.seamEdges.empty() ? std::uint8_t(0) : topology.seamEdges[triangle];
}

std::vector<SurfaceFeatures::BorderEdge> borderEdges(const GroundMesh& mesh,
                                                     const Topology& topology)
{
    std::vector<SurfaceFeatures::BorderEdge> borders;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t e = 0; mesh.bears[t] != 0 && topology.originalOf[t] == t && e < 3; ++e)
            if ((unsigned(topology.borderEdges[t] & ~seamsOf(topology, t)) >> e & 1U) != 0)
                borders.push_back({mesh.positions[mesh.triangles[t][e]],
                                   mesh.positions[mesh.triangles[t][(e + 1) % 3]]});
    return borders;
}

// One corner of a triangle: its welded vertex, and the edges to the other two.
struct Corner {
    std::uint32_t vertex;
    glm::dvec3 toRight;
    glm::dvec3 toLeft;
};

// Calls visit(corner) for all corners of triangles without duplicates.
template <typename Visit>
void forEachCorner(const GroundMesh& mesh, const Topology& topology, Visit visit)
{
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (topology.originalOf[t] != t)
            continue;
        const glm::uvec3 corners = mesh.triangles[t];
        for (glm::length_t c = 0; c < 3; ++c) {
            const glm::dvec3 at(mesh.positions[corners[c]]);
            visit(Corner{topology.weldOf[corners[c]],
                         glm::dvec3(mesh.positions[corners[(c + 1) % 3]]) - at,
                         glm::dvec3(mesh.positions[corners[(c + 2) % 3]]) - at});
        }
    }
}

// Normals of welded vertices, exact if the neighbourhood lies on a sphere; 0 if there is none.
std::vector<glm::dvec3> weldedNormals(const GroundMesh& mesh, const Topology& topology)
{
    std::vector<glm::dvec3> normals(topology.weldedVertices, glm::dvec3(0.0));
    forEachCorner(mesh, topology, [&](const Corner& corner) {
        const double weight =
            glm::dot(corner.toRight, corner.toRight) * glm::dot(corner.toLeft, corner.toLeft);
        if (weight > 0.0)
            normals[corner.vertex] += glm::cross(corner.toRight, corner.toLeft) / weight;
    });
    tbb::parallel_for(std::size_t(0), normals.size(), [&](std::size_t v) {
        const double length = glm::length(normals[v]);
        normals[v] = length > 0.0 ? normals[v] / length : glm::dvec3(0.0);
    });
    return normals;
}

// Cotangent of the angle between two edges, not below 0.
double cotangent(glm::dvec3 a, glm::dvec3 b)
{
    const double sine = glm::length(glm::cross(a, b));
    return sine > 0.0 ? std::max(glm::dot(a, b) / sine, 0.0) : 0.0;
}

// 1 per welded vertex on a border or broken edge.
std::vector<std::uint8_t> roughVertices(const GroundMesh& mesh, const Topology& topology)
{
    std::vector<std::uint8_t> rough(topology.weldedVertices, 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t e = 0; e < 3; ++e)
            if ((unsigned(topology.borderEdges[t] | topology.brokenEdges[t]) >> e & 1U) != 0)
                rough[topology.weldOf[mesh.triangles[t][e]]] =
                    rough[topology.weldOf[mesh.triangles[t][(e + 1) % 3]]] = 1;
    return rough;
}

// Sums of a quantity and of its weights; their quotient is its mean.
struct Mean {
    double sum = 0.0;
    double weight = 0.0;

    void add(double value, double share)
    {
        sum += share * value;
        weight += share;
    }
    double value() const { return weight > 0.0 ? sum / weight : 0.0; }
};

} // namespace

std::vector<float> meanCurvature(const GroundMesh& mesh, const Topology& topology)
{
    // Visit each edge from both of its triangles.
    const std::vector<glm::dvec3> normals = weldedNormals(mesh, topology);
    std::vector<Mean> means(topology.weldedVertices);
    forEachCorner(mesh, topology, [&](const Corner& corner) {
        const glm::dvec3 across = corner.toLeft - corner.toRight;
        const glm::dvec3 normal = normals[corner.vertex];
        Mean& mean = means[corner.vertex];
        // The weight cot·|e|² times the curvature −2 n·e/|e|²: the length cancels.
        const double right = cotangent(-corner.toLeft, -across);
        const double left = cotangent(-corner.toRight, across);
        mean.sum -= 2.0 * (right * glm::dot(normal, corner.toRight) +
                           left * glm::dot(normal, corner.toLeft));
        mean.weight += right * glm::dot(corner.toRight, corner.toRight) +
                       left * glm::dot(corner.toLeft, corner.toLeft);
    });

    // A rough vertex takes the mean of its smooth neighbours.
    const std::vector<std::uint8_t> rough = roughVertices(mesh, topology);
    std::vector<Mean> borrowed(topology.weldedVertices);
    for (const glm::uvec3& t : mesh.triangles)
        for (glm::length_t c = 0; c < 3; ++c) {
            const std::uint32_t own = topology.weldOf[t[c]];
            for (glm::length_t other = 1; rough[own] != 0 && other < 3; ++other) {
                const std::uint32_t vertex = topology.weldOf[t[(c + other) % 3]];
                if (rough[vertex] == 0)
                    borrowed[own].add(means[vertex].value(), 1.0);
            }
        }

    std::vector<float> curvature(mesh.positions.size());
    tbb::parallel_for(std::size_t(0), curvature.size(), [&](std::size_t v) {
        const std::uint32_t vertex = topology.weldOf[v];
        curvature[v] = static_cast<float>((rough[vertex] != 0 ? borrowed : means)[vertex].value());
    });
    return curvature;
}

SurfaceFeatures findFeatures(const GroundMesh& mesh, const Topology& topology,
                             const FeatureChoice& choice)
{
    SurfaceFeatures features;
    features.seamVertices = topology.seamVertexCount;
    features.seamEdges = topology.seamEdgeCount;
    if (choice.curvature)
        features.curvature = meanCurvature(mesh, topology);
    if (choice.islands)
        features.islandArea = islandAreas(mesh, topology);
    if (choice.borders)
        features.borders = borderEdges(mesh, topology);
    return features;
}

std::vector<SurfaceFeatures::BorderEdge> bareEdges(const GroundMesh& mesh)
{
    std::vector<SurfaceFeatures::BorderEdge> edges;
    const auto bears = [](std::uint8_t one) { return one != 0; };
    if (std::none_of(mesh.bears.begin(), mesh.bears.end(), bears) ||
        std::all_of(mesh.bears.begin(), mesh.bears.end(), bears))
        return edges;

    // List the edges of bare triangles, then find those of bearing ones among them.
    std::uint32_t welded = 0;
    const std::vector<std::uint32_t> weldOf = weld(mesh.positions, welded);
    const auto keyOf = [&](std::size_t triangle, glm::length_t e) {
        const std::uint32_t a = weldOf[mesh.triangles[triangle][e]];
        const std::uint32_t b = weldOf[mesh.triangles[triangle][(e + 1) % 3]];
        return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    };
    using Side = std::pair<std::uint64_t, std::uint32_t>;
    std::vector<Side> bare;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t e = 0; mesh.bears[t] == 0 && e < 3; ++e)
            bare.emplace_back(keyOf(t, e), t);
    std::sort(bare.begin(), bare.end());
    constexpr double levelCosine = 0.70710678118654752;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t e = 0; mesh.bears[t] != 0 && e < 3; ++e) {
            const std::uint64_t key = keyOf(t, e);
            auto side = std::lower_bound(bare.begin(), bare.end(), Side(key, 0));
            const auto isLevel = [&](std::uint32_t other) {
                return glm::dot(mesh.faceNormal(t), mesh.faceNormal(other)) > levelCosine;
            };
            while (side != bare.end() && side->first == key && !isLevel(side->second))
                ++side;
            if (side != bare.end() && side->first == key)
                edges.push_back({mesh.positions[mesh.triangles[t][e]],
                                 mesh.positions[mesh.triangles[t][(e + 1) % 3]]});
        }
    return edges;
}

SurfaceFeatures partOf(const SurfaceFeatures& whole, std::span<const std::uint32_t> vertices,
                       std::span<const std::uint32_t> triangles, const Aabb& box, double reach)
{
    SurfaceFeatures part;
    if (!whole.curvature.empty())
        for (const std::uint32_t vertex : vertices)
            part.curvature.push_back(whole.curvature[vertex]);
    if (!whole.islandArea.empty())
        for (const std::uint32_t triangle : triangles)
            part.islandArea.push_back(whole.islandArea[triangle]);

    // Keep an edge if its box is within reach.
    const glm::dvec3 low = glm::dvec3(box.low) - reach;
    const glm::dvec3 high = glm::dvec3(box.high) + reach;
    const auto inReach = [&](const auto& edge) {
        return glm::all(glm::lessThanEqual(glm::dvec3(glm::min(edge.from, edge.to)), high)) &&
               glm::all(glm::greaterThanEqual(glm::dvec3(glm::max(edge.from, edge.to)), low));
    };
    std::copy_if(whole.borders.begin(), whole.borders.end(), std::back_inserter(part.borders),
                 inReach);
    std::copy_if(whole.bareEdges.begin(), whole.bareEdges.end(), std::back_inserter(part.bareEdges),
                 inReach);
    std::copy_if(whole.creases.begin(), whole.creases.end(), std::back_inserter(part.creases),
                 inReach);
    return part;
}

} // namespace sward::terrain
