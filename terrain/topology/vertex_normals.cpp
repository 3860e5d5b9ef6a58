#include "core/math/exact_math.h"
#include "terrain/topology/topology.h"

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace sward::terrain {
namespace {

// A corner is 3·triangle + its number. The corners of welded vertex v begin at corners[first[v]].
struct Corners {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> corners;
};

Corners cornersByVertex(const GroundMesh& mesh, const Topology& topology)
{
    Corners result;
    result.first.assign(topology.weldedVertices + 1, 0);
    const auto vertexOf = [&](std::size_t corner) {
        return topology.weldOf[mesh.triangles[corner / 3][int(corner % 3)]];
    };
    const std::size_t count = 3 * mesh.triangles.size();
    for (std::size_t corner = 0; corner < count; ++corner)
        ++result.first[vertexOf(corner) + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
    result.corners.resize(count);
    for (std::size_t corner = 0; corner < count; ++corner)
        result.corners[next[vertexOf(corner)]++] = static_cast<std::uint32_t>(corner);
    return result;
}

// Normal of the corner's triangle, weighted by its angle there.
glm::dvec3 weightedNormal(const GroundMesh& mesh, std::uint32_t corner)
{
    const glm::uvec3 t = mesh.triangles[corner / 3];
    const auto c = static_cast<glm::length_t>(corner % 3);
    const glm::dvec3 at(mesh.positions[t[c]]);
    const glm::dvec3 right = glm::dvec3(mesh.positions[t[(c + 1) % 3]]) - at;
    const glm::dvec3 left = glm::dvec3(mesh.positions[t[(c + 2) % 3]]) - at;
    const glm::dvec3 normal = glm::cross(right, left);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length * exactAtan2(length, glm::dot(right, left))
                        : glm::dvec3(0.0);
}

// Processes one welded vertex at a time; reuses its arrays.
class VertexSmoother {
public:
    VertexSmoother(const GroundMesh& mesh, const Topology& topology,
                   std::vector<glm::vec3>& normals)
        : mesh_(mesh)
        , topology_(topology)
        , normals_(normals)
    {
    }

    void smooth(const std::uint32_t* corners, std::size_t count)
    {
        // Join corners across edges that are neither border nor crease.
        group_.resize(count);
        std::iota(group_.begin(), group_.end(), std::size_t(0));
        spokes_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t triangle = corners[i] / 3;
            const auto c = static_cast<glm::length_t>(corners[i] % 3);
            addSpoke(triangle, c, (c + 1) % 3, i);
            addSpoke(triangle, (c + 2) % 3, (c + 2) % 3, i);
        }
        std::sort(spokes_.begin(), spokes_.end());
        for (std::size_t i = 1; i < spokes_.size(); ++i)
            if (spokes_[i].first == spokes_[i - 1].first)
                join(spokes_[i].second, spokes_[i - 1].second);

        // Add up each group in the order of its triangles.
        sums_.assign(count, glm::dvec3(0.0));
        for (std::size_t i = 0; i < count; ++i)
            sums_[find(i)] += weightedNormal(mesh_, corners[i]);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 sum = sums_[find(i)];
            const double length = glm::length(sum);
            // Use up where no triangle has an area.
            normals_[corners[i]] =
                length > 1e-9 ? glm::vec3(sum / length) : glm::vec3(0.0f, 1.0f, 0.0f);
        }
    }

private:
    // The edge `e` of the triangle leads from the vertex to corner `to`.
    void addSpoke(std::uint32_t triangle, glm::length_t e, glm::length_t to, std::size_t corner)
    {
        const unsigned bit = 1U << e;
        if ((topology_.borderEdges[triangle] & bit) == 0 &&
            (topology_.creaseEdges[triangle] & bit) == 0)
            spokes_.emplace_back(topology_.weldOf[mesh_.triangles[triangle][to]], corner);
    }

    std::size_t find(std::size_t i) const
    {
        while (group_[i] != i)
            i = group_[i];
        return i;
    }

    void join(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        group_[std::max(a, b)] = std::min(a, b);
    }

    const GroundMesh& mesh_;
    const Topology& topology_;
    std::vector<glm::vec3>& normals_; // per corner
    std::vector<std::size_t> group_;
    std::vector<std::pair<std::uint32_t, std::size_t>> spokes_; // other vertex, corner
    std::vector<glm::dvec3> sums_;
};

// Assigns each vertex the normal of its first corner; corners with another normal get a copy.
void assignNormals(GroundMesh& mesh, const std::vector<glm::vec3>& cornerNormals)
{
    constexpr std::uint32_t none = 0xffffffffU;
    const std::size_t original = mesh.positions.size();
    std::vector<bool> assigned(original, false);
    std::vector<std::uint32_t> nextCopy(original, none);
    mesh.normals.assign(original, glm::vec3(0.0f, 1.0f, 0.0f));
    for (std::size_t corner = 0; corner < cornerNormals.size(); ++corner) {
        std::uint32_t& vertex = mesh.triangles[corner / 3][int(corner % 3)];
        const glm::vec3 normal = cornerNormals[corner];
        if (!assigned[vertex]) {
            assigned[vertex] = true;
            mesh.normals[vertex] = normal;
        }
        // Search the copies made before.
        std::uint32_t copy = vertex;
        while (mesh.normals[copy] != normal && nextCopy[copy] != none)
            copy = nextCopy[copy];
        if (mesh.normals[copy] != normal) {
            nextCopy[copy] = static_cast<std::uint32_t>(mesh.positions.size());
            nextCopy.push_back(none);
            mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
            mesh.uvs.push_back(glm::vec2(mesh.uvs[vertex]));
            mesh.colors.push_back(glm::vec4(mesh.colors[vertex]));
            mesh.normals.push_back(normal);
            mesh.attributes.copyVertex(vertex);
            copy = nextCopy[copy];
        }
        vertex = copy;
    }
}

} // namespace

void computeNormals(GroundMesh& mesh, const Topology& topology)
{
    const Corners byVertex = cornersByVertex(mesh, topology);
    std::vector<glm::vec3> cornerNormals(3 * mesh.triangles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, topology.weldedVertices, 4096),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          VertexSmoother smoother(mesh, topology, cornerNormals);
                          for (std::size_t v = range.begin(); v != range.end(); ++v)
                              smoother.smooth(byVertex.corners.data() + byVertex.first[v],
                                              byVertex.first[v + 1] - byVertex.first[v]);
                      });
    assignNormals(mesh, cornerNormals);
}

} // namespace sward::terrain
