#include "terrain/topology/convex_creases.h"

#include "terrain/topology/weld.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sward::terrain {
namespace {

// Cosines of the least and of the greatest angle between two normals: about 26° and 154°. Below,
// blades leave no gap. Above, the sheet is folded on itself and has no direction between.
constexpr double minTurnCosine = 0.9;
constexpr double maxTurnCosine = -0.9;

// Sine of the least angle at which a neighbour must fall below a triangle's plane.
constexpr double minFall = 0.02;

// Edge e of a triangle runs from corner e to corner e+1.
struct CreaseSide {
    std::uint64_t key; // both welded vertices, the smaller one first
    std::uint32_t triangle;
    std::uint32_t edge;
    bool rises; // from the smaller vertex to the larger one
};

glm::dvec3 normalised(glm::dvec3 v)
{
    const double squared = glm::dot(v, v);
    return squared > 0.0 ? v / std::sqrt(squared) : v;
}

// Mean normal along an edge of a triangle, on its front.
glm::dvec3 normalAlong(const GroundMesh& mesh, const CreaseSide& side)
{
    const glm::dvec3 face = mesh.faceNormal(side.triangle);
    const glm::uvec3 corners = mesh.triangles[side.triangle];
    const auto e = static_cast<glm::length_t>(side.edge);
    const glm::dvec3 mean =
        normalised(glm::dvec3(mesh.normals[corners[e]]) + glm::dvec3(mesh.normals[corners[(e + 1) % 3]]));
    return glm::dot(mean, face) > 0.0 ? mean : face;
}

// How far the third corner of the other triangle lies above the plane of this one, as a sine.
double riseBeyond(const GroundMesh& mesh, const CreaseSide& own, const CreaseSide& other)
{
    const auto e = static_cast<glm::length_t>(other.edge);
    const glm::uvec3 corners = mesh.triangles[other.triangle];
    const glm::dvec3 beyond = glm::dvec3(mesh.positions[corners[(e + 2) % 3]]) -
                              glm::dvec3(mesh.positions[corners[e]]);
    return glm::dot(normalised(beyond), mesh.faceNormal(own.triangle));
}

// Edges of which an end shares its position with another vertex: others have one normal at each
// end.
std::vector<CreaseSide> splitSides(const GroundMesh& mesh)
{
    std::uint32_t welded = 0;
    const std::vector<std::uint32_t> weldOf = weld(mesh.positions, welded);
    std::vector<CreaseSide> sides;
    if (welded == mesh.positions.size())
        return sides;
    std::vector<std::uint8_t> copies(welded, 0);
    for (const std::uint32_t vertex : weldOf)
        copies[vertex] = static_cast<std::uint8_t>(std::min(copies[vertex] + 1, 2));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::uint32_t e = 0; e < 3; ++e) {
            const auto corner = static_cast<glm::length_t>(e);
            const std::uint32_t a = weldOf[mesh.triangles[t][corner]];
            const std::uint32_t b = weldOf[mesh.triangles[t][(corner + 1) % 3]];
            if (a != b && (copies[a] > 1 || copies[b] > 1))
                sides.push_back(
                    {std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), t, e, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const CreaseSide& a, const CreaseSide& b) {
        return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
    });
    return sides;
}

} // namespace

std::vector<ConvexCrease> convexCreases(const GroundMesh& mesh, CreaseSides sides)
{
    std::vector<ConvexCrease> creases;
    const std::vector<CreaseSide> all = splitSides(mesh);
    std::size_t end = 0;
    for (std::size_t first = 0; first < all.size(); first = end) {
        end = first + 1;
        while (end < all.size() && all[end].key == all[first].key)
            ++end;
        // Two triangles whose fronts agree run along their edge in opposite directions.
        const CreaseSide& one = all[first];
        if (end != first + 2 || one.rises == all[first + 1].rises)
            continue;
        const CreaseSide& two = all[first + 1];
        if (mesh.bears[one.triangle] == 0 && mesh.bears[two.triangle] == 0)
            continue;
        const glm::dvec3 ownNormal = normalAlong(mesh, one);
        const glm::dvec3 otherNormal = normalAlong(mesh, two);
        const double turn = glm::dot(ownNormal, otherNormal);
        if (!(turn < minTurnCosine && turn > maxTurnCosine))
            continue;
        const double rise = riseBeyond(mesh, one, two);
        const bool isConvex = rise < -minFall;
        if (isConvex ? !sides.front : !(sides.back && rise > minFall))
            continue;
        const double front = isConvex ? 1.0 : -1.0;
        const auto corner = static_cast<glm::length_t>(one.edge);
        creases.push_back({mesh.positions[mesh.triangles[one.triangle][corner]],
                           mesh.positions[mesh.triangles[one.triangle][(corner + 1) % 3]],
                           {glm::vec3(front * ownNormal), glm::vec3(front * otherNormal)}});
    }
    return creases;
}

} // namespace sward::terrain
