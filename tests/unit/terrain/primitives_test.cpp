#include "support/meshes.h"
#include "terrain/procedural/primitives.h"
#include "terrain/topology/topology.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

constexpr double pi = 3.14159265358979323846;

TEST(Plane, IsLevelAndOfItsSize)
{
    const GroundMesh mesh =
        makePlane({.size = glm::dvec2(20.0, 10.0), .cells = glm::uvec2(4U, 2U)});
    EXPECT_EQ(mesh.triangles.size(), 16U);
    EXPECT_DOUBLE_EQ(meshes::totalArea(mesh), 200.0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        EXPECT_EQ(mesh.faceNormal(i), glm::dvec3(0, 1, 0));
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

TEST(Sphere, ApproachesItsAreaAndVolumeFromBelow)
{
    // An inscribed polyhedron of n segments lacks a share of about π²/n² · (1 + …) of either.
    double last = 1.0;
    for (const std::uint32_t segments : {16U, 32U, 64U, 128U}) {
        const GroundMesh mesh =
            makeSphere({.radius = 3.0, .segments = segments, .rings = segments / 2});
        const double area = meshes::totalArea(mesh) / (4.0 * pi * 9.0);
        const double volume = meshes::signedVolume(mesh) / (4.0 / 3.0 * pi * 27.0);
        EXPECT_LT(area, 1.0);
        EXPECT_LT(volume, 1.0);
        EXPECT_NEAR((1.0 - area) / last, segments == 16 ? 1.0 - area : 0.25, 0.01);
        last = 1.0 - area;
    }
    EXPECT_LT(last, 6e-4);
}

TEST(Sphere, HasRadialNormalsAndARingOnItsEquator)
{
    const GroundMesh mesh = makeSphere();
    std::size_t onEquator = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(mesh.positions[i]);
        EXPECT_NEAR(glm::length(p), 10.0, 1e-5);
        EXPECT_LT(glm::length(p / 10.0 - glm::dvec3(mesh.normals[i])), 2e-7);
        onEquator += p.y == 0.0 ? 1U : 0U;
    }
    EXPECT_EQ(onEquator, 129U);
}

TEST(Sphere, HalvesOnItsEquator)
{
    const GroundMesh mesh = makeSphere();
    double above = 0.0;
    double below = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        const float y = mesh.positions[t.x].y + mesh.positions[t.y].y + mesh.positions[t.z].y;
        (y > 0.0f ? above : below) += mesh.area(i);
    }
    EXPECT_NEAR(above / below, 1.0, 1e-6);
}

TEST(Sphere, IsClosedWithoutFlatTriangles)
{
    const Topology topology = analyse(makeSphere());
    EXPECT_EQ(topology.borderEdgeCount, 0U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.degenerateTriangles, 0U);
    EXPECT_EQ(topology.weldedVertices, 128U * 63U + 2U);
}

TEST(Torus, HasTheAreaAndVolumeOfItsFormula)
{
    const GroundMesh mesh = makeTorus();
    EXPECT_NEAR(meshes::totalArea(mesh) / (4.0 * pi * pi * 8.0 * 3.0), 1.0, 2e-3);
    EXPECT_NEAR(meshes::signedVolume(mesh) / (2.0 * pi * pi * 8.0 * 9.0), 1.0, 3e-3);
}

TEST(Torus, IsClosedWithOneHole)
{
    const GroundMesh mesh = makeTorus({.majorSegments = 32, .minorSegments = 16});
    const Topology topology = analyse(mesh);
    EXPECT_EQ(topology.borderEdgeCount, 0U);
    // Euler's number, V − E + F, is 0.
    EXPECT_EQ(topology.weldedVertices + mesh.triangles.size(), mesh.triangles.size() * 3 / 2);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_GT(glm::dot(mesh.faceNormal(i), glm::dvec3(mesh.normals[mesh.triangles[i][c]])),
                      0.9);
}

} // namespace
} // namespace sward::terrain
