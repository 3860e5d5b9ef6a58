#include "terrain/topology/half_edges.h"

#include "core/random.h"
#include "terrain/topology/quiet_openmesh.h"
#include "terrain/topology/vertex_fans.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include <algorithm>
#include <bit>
#include <numeric>

namespace sward::terrain {
namespace {

using OpenMesh::VertexHandle;

// An edge of one triangle and its two welded vertices, the lower in the upper bits.
struct OpenEdge {
    std::uint64_t key = 0;
    std::uint32_t triangle = 0;
    glm::length_t edge = 0;
    bool forward = false; // from the lower to the higher vertex

    bool operator<(const OpenEdge& other) const
    {
        return key != other.key ? key < other.key : triangle < other.triangle;
    }
};

OpenEdge openEdge(const std::vector<glm::uvec3>& triangles, std::uint32_t triangle,
                  glm::length_t edge)
{
    const std::uint32_t from = triangles[triangle][edge];
    const std::uint32_t to = triangles[triangle][(edge + 1) % 3];
    return {.key = (std::uint64_t(std::min(from, to)) << 32) | std::max(from, to),
            .triangle = triangle,
            .edge = edge,
            .forward = from < to};
}

class Builder {
public:
    Builder(const std::vector<glm::uvec3>& triangles, std::uint32_t vertices)
        : triangles_(triangles)
        , vertices_(vertices)
    {
        const std::size_t n = triangles.size();
        result_.neighbours.assign(n, glm::uvec3(Adjacency::none));
        result_.reversedEdges.assign(n, 0);
        result_.crowdedEdges.assign(n, 0);
        result_.collapsed.assign(n, 0);
        result_.originalOf.resize(n);
        std::iota(result_.originalOf.begin(), result_.originalOf.end(), 0U);
    }

    Adjacency run()
    {
        findCollapsedAndRepeated();
        addFaces();
        readNeighbours();
        if (!refused_.empty())
            sew();
        countSplitVertices();
        copyToRepeated();
        return std::move(result_);
    }

private:
    bool isPlain(std::size_t triangle) const
    {
        return result_.collapsed[triangle] == 0 && result_.originalOf[triangle] == triangle;
    }

    // Marks triangles that a half-edge mesh cannot hold: collapsed and repeated ones.
    void findCollapsedAndRepeated()
    {
        const auto sorted = [&](std::size_t i) {
            glm::uvec3 t = triangles_[i];
            if (t.x > t.y)
                std::swap(t.x, t.y);
            if (t.y > t.z)
                std::swap(t.y, t.z);
            if (t.x > t.y)
                std::swap(t.x, t.y);
            return t;
        };
        const std::size_t slots = std::bit_ceil(2 * triangles_.size() + 1);
        std::vector<std::uint32_t> table(slots, Adjacency::none);
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const glm::uvec3 t = sorted(i);
            if (t.x == t.y || t.y == t.z) {
                result_.collapsed[i] = 1;
                continue;
            }
            std::size_t slot = hashBits((std::uint64_t(t.x) << 32) | t.y, t.z) & (slots - 1);
            while (table[slot] != Adjacency::none && sorted(table[slot]) != t)
                slot = (slot + 1) & (slots - 1);
            if (table[slot] == Adjacency::none)
                table[slot] = static_cast<std::uint32_t>(i);
            else
                result_.originalOf[i] = table[slot];
        }
    }

    VertexHandle handle(std::uint32_t vertex) const
    {
        return VertexHandle(static_cast<int>(vertex));
    }

    void addFaces()
    {
        const QuietOpenMesh quiet;
        mesh_.reserve(vertices_, triangles_.size() * 3 / 2 + vertices_ / 8, triangles_.size());
        mesh_.resize(vertices_, 0, 0);
        triangleOf_.reserve(triangles_.size());
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (!isPlain(i))
                continue;
            const glm::uvec3 t = triangles_[i];
            if (mesh_.add_face(handle(t.x), handle(t.y), handle(t.z)).is_valid())
                triangleOf_.push_back(static_cast<std::uint32_t>(i));
            else
                refused_.push_back(static_cast<std::uint32_t>(i));
        }

        // Duplicate the vertices of rejected triangles, so that they are accepted.
        firstDetached_ = triangleOf_.size();
        for (const std::uint32_t triangle : refused_) {
            const VertexHandle a = mesh_.add_vertex();
            const VertexHandle b = mesh_.add_vertex();
            const VertexHandle c = mesh_.add_vertex();
            mesh_.add_face(a, b, c);
            triangleOf_.push_back(triangle);
        }
    }

    // The triangle edge along the half-edge.
    glm::length_t edgeOf(OpenMesh::HalfedgeHandle halfEdge, std::uint32_t triangle) const
    {
        const auto from = static_cast<std::uint32_t>(mesh_.from_vertex_handle(halfEdge).idx());
        const glm::uvec3 t = triangles_[triangle];
        return t.x == from ? 0 : t.y == from ? 1 : 2;
    }

    void readNeighbours()
    {
        for (std::size_t face = 0; face < firstDetached_; ++face) {
            const std::uint32_t triangle = triangleOf_[face];
            auto halfEdge = mesh_.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(face)));
            for (int i = 0; i < 3; ++i, halfEdge = mesh_.next_halfedge_handle(halfEdge)) {
                const auto other = mesh_.face_handle(mesh_.opposite_halfedge_handle(halfEdge));
                if (other.is_valid())
                    result_.neighbours[triangle][edgeOf(halfEdge, triangle)] =
                        triangleOf_[static_cast<std::size_t>(other.idx())];
            }
        }
    }

    // Connects the rejected triangles with their neighbours.
    void sew()
    {
        // Collect edges with less than two triangles, and all edges of rejected triangles.
        std::vector<OpenEdge> open;
        for (std::size_t face = 0; face < firstDetached_; ++face)
            for (glm::length_t e = 0; e < 3; ++e)
                if (result_.neighbours[triangleOf_[face]][e] == Adjacency::none)
                    open.push_back(openEdge(triangles_, triangleOf_[face], e));
        for (const std::uint32_t triangle : refused_)
            for (glm::length_t e = 0; e < 3; ++e) {
                const OpenEdge edge = openEdge(triangles_, triangle, e);
                open.push_back(edge);
                addFullEdge(edge, open);
            }
        std::sort(open.begin(), open.end());

        // Each run of equal keys is one edge.
        for (auto first = open.begin(); first != open.end();) {
            auto last = first;
            std::vector<OpenEdge> sharers;
            for (; last != open.end() && last->key == first->key; ++last)
                if (sharers.empty() || sharers.back().triangle != last->triangle)
                    sharers.push_back(*last);
            join(sharers);
            first = last;
        }
    }

    // Adds the triangles that already share a full edge with a rejected triangle.
    void addFullEdge(const OpenEdge& edge, std::vector<OpenEdge>& open) const
    {
        const auto low = static_cast<std::uint32_t>(edge.key >> 32);
        const auto high = static_cast<std::uint32_t>(edge.key & 0xffffffffU);
        const auto halfEdge = mesh_.find_halfedge(handle(low), handle(high));
        if (!halfEdge.is_valid())
            return;
        for (const auto side : {OpenMesh::HalfedgeHandle(halfEdge),
                                OpenMesh::HalfedgeHandle(mesh_.opposite_halfedge_handle(halfEdge))})
            if (const auto face = mesh_.face_handle(side); face.is_valid()) {
                const std::uint32_t triangle = triangleOf_[static_cast<std::size_t>(face.idx())];
                open.push_back(openEdge(triangles_, triangle, edgeOf(side, triangle)));
            }
    }

    void join(const std::vector<OpenEdge>& sharers)
    {
        if (sharers.size() < 2)
            return;
        const bool crowded = sharers.size() > 2;
        for (std::size_t i = 0; i < sharers.size(); ++i) {
            const OpenEdge& own = sharers[i];
            const OpenEdge& other = sharers[i == 0 ? 1 : 0];
            const auto bit = static_cast<std::uint8_t>(1U << own.edge);
            result_.neighbours[own.triangle][own.edge] = other.triangle;
            if (crowded)
                result_.crowdedEdges[own.triangle] |= bit;
            else if (own.forward == other.forward)
                result_.reversedEdges[own.triangle] |= bit;
        }
        if (crowded)
            ++result_.crowdedEdgeCount;
    }

    // At a vertex with problems in OpenMesh, triangles that share an edge form one fan.
    void countSplitVertices()
    {
        std::vector<bool> suspect(vertices_, false);
        for (std::uint32_t v = 0; v < vertices_; ++v)
            suspect[v] = !mesh_.is_isolated(handle(v)) && !mesh_.is_manifold(handle(v));
        for (const std::uint32_t triangle : refused_)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                suspect[triangles_[triangle][corner]] = true;

        std::vector<std::pair<std::uint32_t, std::uint32_t>> around; // vertex, triangle
        for (const std::uint32_t triangle : triangleOf_)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                if (suspect[triangles_[triangle][corner]])
                    around.emplace_back(triangles_[triangle][corner], triangle);
        std::sort(around.begin(), around.end());
        for (auto first = around.begin(); first != around.end();) {
            const auto last = std::find_if(first, around.end(), [&](const auto& entry) {
                return entry.first != first->first;
            });
            std::vector<std::uint32_t> fan;
            for (auto entry = first; entry != last; ++entry)
                fan.push_back(entry->second);
            if (countFans(fan, first->first, triangles_, result_.neighbours) > 1)
                ++result_.splitVertexCount;
            first = last;
        }
    }

    void copyToRepeated()
    {
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const std::uint32_t original = result_.originalOf[i];
            if (original == i)
                continue;
            for (glm::length_t e = 0; e < 3; ++e)
                for (glm::length_t o = 0; o < 3; ++o)
                    if (openEdge(triangles_, static_cast<std::uint32_t>(i), e).key ==
                        openEdge(triangles_, original, o).key)
                        result_.neighbours[i][e] = result_.neighbours[original][o];
        }
    }

    const std::vector<glm::uvec3>& triangles_;
    std::uint32_t vertices_;
    OpenMesh::TriConnectivity mesh_;
    std::vector<std::uint32_t> triangleOf_; // per face of OpenMesh
    std::size_t firstDetached_ = 0;
    std::vector<std::uint32_t> refused_;
    Adjacency result_;
};

} // namespace

Adjacency findNeighbours(const std::vector<glm::uvec3>& triangles, std::uint32_t vertices)
{
    return Builder(triangles, vertices).run();
}

} // namespace sward::terrain
