#include "support/meshes.h"

#include "core/math/exact_math.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/procedural/primitives.h"
#include "terrain/topology/soup.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace sward::meshes {
namespace {

using terrain::GroundMesh;

constexpr double pi = 3.14159265358979323846;

GroundMesh transformed(const GroundMesh& mesh, const glm::dmat4& matrix)
{
    terrain::Soup soup = terrain::soupOf(mesh);
    terrain::transform(soup, matrix);
    GroundMesh result = terrain::settle(std::move(soup), "test mesh");
    result.bears = mesh.bears;
    return result;
}

} // namespace

GroundMesh soup(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles)
{
    terrain::Soup made;
    made.positions = positions;
    made.triangles = triangles;
    return terrain::settle(std::move(made), "test mesh");
}

GroundMesh triangle()
{
    return soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}});
}

GroundMesh square(double side, double height)
{
    const double h = side / 2.0;
    return soup({{-h, height, -h}, {-h, height, h}, {h, height, -h}, {h, height, h}},
                {{0, 1, 2}, {2, 1, 3}});
}

GroundMesh grid(std::uint32_t cells, double side)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(cells)},
                                [](double, double) { return 0.0; });
}

GroundMesh hills(double side, std::uint32_t cells)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(cells)}, [](double x, double z) {
        return 5.0 * exactSinCos(0.11 * x + 0.3).sin * exactSinCos(0.07 * z).cos +
               2.0 * exactSinCos(0.31 * z - 0.1 * x).sin;
    });
}

GroundMesh cube(double side)
{
    const double h = side / 2.0;
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1) != 0 ? h : -h, (i & 2) != 0 ? h : -h, (i & 4) != 0 ? h : -h);
    return soup(corners, {{0, 4, 6},
                          {0, 6, 2},
                          {1, 3, 7},
                          {1, 7, 5},
                          {0, 1, 5},
                          {0, 5, 4},
                          {2, 6, 7},
                          {2, 7, 3},
                          {0, 2, 3},
                          {0, 3, 1},
                          {4, 5, 7},
                          {4, 7, 6}});
}

GroundMesh areaRatioPair()
{
    return soup({{0, 0, 0}, {0, 0, 40}, {25, 0, 0}, {-2, 0, 0}, {-2, 0, 1}, {-1, 0, 0}},
                {{0, 1, 2}, {3, 4, 5}});
}

GroundMesh sphere(std::uint32_t segments, double radius)
{
    return terrain::makeSphere({.radius = radius, .segments = segments, .rings = segments / 4 * 2});
}

GroundMesh book()
{
    std::vector<glm::dvec3> positions = {{0, 0, 0}, {0, 0, 1}};
    std::vector<glm::uvec3> triangles;
    for (const double degrees : {0.0, 100.0, 200.0}) {
        const SinCos turn = exactSinCos(degrees * pi / 180.0);
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.emplace_back(turn.cos, turn.sin, 0.0);
        positions.emplace_back(turn.cos, turn.sin, 1.0);
        triangles.emplace_back(0U, 1U, first);
        triangles.emplace_back(first, 1U, first + 1U);
    }
    return soup(positions, triangles);
}

GroundMesh moebius(std::uint32_t segments)
{
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(segments);
        const SinCos around = exactSinCos(2.0 * pi * share);
        const SinCos twist = exactSinCos(pi * share);
        const glm::dvec3 outward(around.cos, 0.0, around.sin);
        const glm::dvec3 across = 0.3 * (twist.cos * outward + glm::dvec3(0.0, twist.sin, 0.0));
        positions.push_back(outward - across);
        positions.push_back(outward + across);
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        const std::uint32_t a = 2 * i;
        const std::uint32_t b = a + 1;
        // After one turn the sides are swapped.
        const bool last = i + 1 == segments;
        const std::uint32_t c = last ? 1 : a + 2;
        const std::uint32_t d = last ? 0 : a + 3;
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(b, d, c);
    }
    return soup(positions, triangles);
}

GroundMesh boxAbovePlane()
{
    GroundMesh mesh = square(10.0);
    append(mesh, moved(cube(2.0), {0.0, 2.0, 0.0}));
    return mesh;
}

GroundMesh rotated(const GroundMesh& mesh, const glm::dquat& turn)
{
    return transformed(mesh, glm::mat4_cast(turn));
}

GroundMesh moved(const GroundMesh& mesh, const glm::dvec3& by)
{
    return transformed(mesh, glm::translate(glm::dmat4(1.0), by));
}

double signedVolume(const GroundMesh& mesh)
{
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles)
        volume +=
            glm::dot(glm::dvec3(mesh.positions[t.x]),
                     glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z]))) /
            6.0;
    return volume;
}

double totalArea(const GroundMesh& mesh)
{
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        area += mesh.area(i);
    return area;
}

} // namespace sward::meshes
