#include "terrain/topology/seams.h"

#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sward::terrain {
namespace {

// A gap wider than this share of the edges beside it is meant, whatever a file's precision is.
constexpr double widestGap = 0.05;

// An edge with one triangle.
struct RimEdge {
    std::uint32_t triangle;
    std::uint8_t edge;
    std::uint32_t from; // welded
    std::uint32_t to;
};

// The open edges of a mesh, their vertices, and a grid that finds vertices by place.
class Rim {
public:
    Rim(const GroundMesh& mesh, const std::vector<glm::uvec3>& triangles,
        const Adjacency& adjacency, const std::vector<std::uint32_t>& weldOf, std::uint32_t count)
        : shortest_(count, std::numeric_limits<double>::infinity())
        , places_(count, glm::dvec3(0.0))
    {
        for (std::size_t v = 0; v < weldOf.size(); ++v)
            places_[weldOf[v]] = glm::dvec3(mesh.positions[v]);
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            if (adjacency.collapsed[t] != 0 || adjacency.originalOf[t] != t)
                continue;
            for (std::uint8_t e = 0; e < 3; ++e)
                if (adjacency.neighbours[t][e] == Adjacency::none)
                    add({t, e, triangles[t][e], triangles[t][(e + 1) % 3]});
        }
        for (std::uint32_t v = 0; v < count; ++v)
            if (std::isfinite(shortest_[v]))
                vertices_.push_back(v);
    }

    const std::vector<RimEdge>& edges() const { return edges_; }
    const std::vector<std::uint32_t>& vertices() const { return vertices_; }
    const glm::dvec3& place(std::uint32_t vertex) const { return places_[vertex]; }
    double meanLength() const { return length_ / double(edges_.size()); }

    // The widest gap that joins a vertex to something.
    double reach(std::uint32_t vertex, double precision) const
    {
        return std::min(precision, widestGap * shortest_[vertex]);
    }

    void sortInto(double cell)
    {
        cell_ = cell;
        for (const std::uint32_t v : vertices_)
            grid_.emplace_back(keyOf(cellOf(places_[v])), v);
        std::sort(grid_.begin(), grid_.end());
    }

    // Visits the vertices in the cells that a box touches; it may visit others.
    template <typename Visit>
    void forEachNear(const glm::dvec3& low, const glm::dvec3& high, Visit visit) const
    {
        const glm::dvec3 first = cellOf(low);
        const glm::dvec3 last = cellOf(high);
        // Beyond that, numbers have no places behind the point.
        constexpr double farthest = 1e15;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (!(first[axis] > -farthest && last[axis] < farthest))
                return;
        for (double x = first.x; x <= last.x; ++x)
            for (double y = first.y; y <= last.y; ++y)
                for (double z = first.z; z <= last.z; ++z) {
                    const std::uint64_t key = keyOf({x, y, z});
                    for (auto at = std::lower_bound(grid_.begin(), grid_.end(),
                                                    std::pair(key, std::uint32_t(0)));
                         at != grid_.end() && at->first == key; ++at)
                        visit(at->second);
                }
    }

private:
    void add(const RimEdge& edge)
    {
        const double length = glm::length(places_[edge.to] - places_[edge.from]);
        for (const std::uint32_t v : {edge.from, edge.to})
            shortest_[v] = std::min(shortest_[v], length);
        length_ += length;
        edges_.push_back(edge);
    }

    glm::dvec3 cellOf(const glm::dvec3& place) const
    {
        return {std::floor(place.x / cell_), std::floor(place.y / cell_),
                std::floor(place.z / cell_)};
    }

    static std::uint64_t keyOf(const glm::dvec3& cell)
    {
        const auto bits = [](double number) {
            return static_cast<std::uint64_t>(
                static_cast<std::int64_t>(std::clamp(number, -9e18, 9e18)));
        };
        return hashBits(hashBits(bits(cell.x), bits(cell.y)), bits(cell.z));
    }

    std::vector<double> shortest_;   // open edge at each vertex [m]; infinite: none
    std::vector<glm::dvec3> places_; // of each vertex
    std::vector<RimEdge> edges_;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> grid_; // cell, vertex
    double length_ = 0.0;                                       // of all edges
    double cell_ = 1.0;
};

// The vertices between the ends of an open edge, in order.
std::vector<std::uint32_t> verticesAlong(const Rim& rim, const RimEdge& edge, double precision)
{
    const glm::dvec3 from = rim.place(edge.from);
    const glm::dvec3 along = rim.place(edge.to) - from;
    const double squared = glm::dot(along, along);
    const double length = std::sqrt(squared);
    const double step = rim.meanLength();
    const double widest = std::min({precision, widestGap * length, step});
    std::vector<std::pair<double, std::uint32_t>> found;
    const auto test = [&](std::uint32_t v) {
        if (v == edge.from || v == edge.to)
            return;
        const glm::dvec3 offset = rim.place(v) - from;
        const double share = glm::dot(offset, along) / squared;
        const double reach = std::min(widest, rim.reach(v, precision));
        const double margin = reach / length;
        if (share > margin && share < 1.0 - margin && glm::length(offset - share * along) <= reach)
            found.emplace_back(share, v);
    };
    // Cut a long edge into pieces, so that the boxes around them stay small.
    constexpr double maxPieces = 4096.0;
    if (!(length > 0.0) || !(length < maxPieces * step))
        return {};
    const int pieces = static_cast<int>(length / step) + 1;
    for (int i = 0; i < pieces; ++i) {
        const glm::dvec3 a = from + along * (double(i) / pieces);
        const glm::dvec3 b = from + along * (double(i + 1) / pieces);
        rim.forEachNear(glm::min(a, b) - widest, glm::max(a, b) + widest, test);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<std::uint32_t> vertices;
    for (const auto& [share, v] : found)
        vertices.push_back(v);
    return vertices;
}

// A piece of an open edge between two vertices next to one another.
struct RimPiece {
    std::uint64_t key;
    std::uint32_t edge; // index into Rim::edges()

    bool operator<(const RimPiece& other) const
    {
        return key != other.key ? key < other.key : edge < other.edge;
    }
};

} // namespace

std::uint64_t weldSeams(const GroundMesh& mesh, const std::vector<glm::uvec3>& triangles,
                        const Adjacency& adjacency, std::vector<std::uint32_t>& weldOf,
                        std::uint32_t& count)
{
    Rim rim(mesh, triangles, adjacency, weldOf, count);
    if (!(mesh.precision > 0.0) || rim.edges().empty())
        return 0;
    rim.sortInto(rim.meanLength());

    // Disjoint sets; the lowest number names a set.
    std::vector<std::uint32_t> parent(count);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto find = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    std::uint64_t joined = 0;
    for (const std::uint32_t v : rim.vertices()) {
        const glm::dvec3 place = rim.place(v);
        const double reach = rim.reach(v, mesh.precision);
        rim.forEachNear(place - reach, place + reach, [&](std::uint32_t other) {
            if (other <= v || glm::length(rim.place(other) - place) >
                                  std::min(reach, rim.reach(other, mesh.precision)))
                return;
            const std::uint32_t a = find(v);
            const std::uint32_t b = find(other);
            joined += a != b ? 1 : 0;
            parent[std::max(a, b)] = std::min(a, b);
        });
    }
    if (joined == 0)
        return 0;

    // The lowest number of a set has appeared first.
    std::vector<std::uint32_t> newNumber(count, 0);
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < count; ++v)
        newNumber[v] = find(v) == v ? next++ : newNumber[find(v)];
    for (std::uint32_t& number : weldOf)
        number = newNumber[number];
    count = next;
    return joined;
}

TJunctions findTJunctions(const GroundMesh& mesh, const std::vector<glm::uvec3>& triangles,
                          const Adjacency& adjacency, const std::vector<std::uint32_t>& weldOf,
                          std::uint32_t count)
{
    TJunctions found;
    Rim rim(mesh, triangles, adjacency, weldOf, count);
    if (!(mesh.precision > 0.0) || rim.edges().empty())
        return found;
    rim.sortInto(rim.meanLength());

    // Cut every edge where vertices lie on it; equal pieces of two edges are a seam.
    std::vector<RimPiece> pieces;
    std::vector<std::uint32_t> alone(rim.edges().size(), 0); // pieces of each edge without another
    bool isCut = false;
    std::vector<std::vector<std::uint32_t>> cuts(rim.edges().size());
    tbb::parallel_for(std::size_t(0), cuts.size(), [&](std::size_t i) {
        cuts[i] = verticesAlong(rim, rim.edges()[i], mesh.precision);
    });
    for (const auto& cut : cuts)
        isCut = isCut || !cut.empty();
    if (!isCut)
        return found;
    for (std::uint32_t i = 0; i < cuts.size(); ++i) {
        std::uint32_t before = rim.edges()[i].from;
        cuts[i].push_back(rim.edges()[i].to);
        alone[i] = static_cast<std::uint32_t>(cuts[i].size());
        for (const std::uint32_t v : cuts[i]) {
            pieces.push_back({std::uint64_t(std::min(before, v)) << 32 | std::max(before, v), i});
            before = v;
        }
    }
    std::sort(pieces.begin(), pieces.end());
    for (auto first = pieces.begin(); first != pieces.end();) {
        auto last = first;
        while (last != pieces.end() && last->key == first->key)
            ++last;
        for (auto piece = first; last - first > 1 && piece != last; ++piece) {
            --alone[piece->edge];
            found.neighbours.emplace_back(rim.edges()[first->edge].triangle,
                                          rim.edges()[piece->edge].triangle);
        }
        first = last;
    }
    found.edges.assign(triangles.size(), 0);
    for (std::size_t i = 0; i < alone.size(); ++i)
        if (alone[i] == 0) {
            const RimEdge& edge = rim.edges()[i];
            found.edges[edge.triangle] |= static_cast<std::uint8_t>(1U << edge.edge);
            ++found.count;
        }
    return found;
}

} // namespace sward::terrain
