#include "support/meshes.h"
#include "terrain/procedural/landforms.h"
#include "terrain/topology/soup.h"
#include "terrain/topology/topology.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace sward::terrain {
namespace {

TEST(ComputeNormals, MakesASphereRadial)
{
    GroundMesh mesh = meshes::sphere(64);
    computeNormals(mesh, analyse(mesh));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_GT(
            glm::dot(glm::dvec3(mesh.normals[i]), glm::dvec3(glm::normalize(mesh.positions[i]))),
            0.9995)
            << "vertex " << i;
}

TEST(ComputeNormals, KeepsTheSidesOfACubeFlat)
{
    const GroundMesh mesh = meshes::cube();
    EXPECT_EQ(mesh.positions.size(), 24U);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_EQ(mesh.normals[mesh.triangles[i][c]], glm::vec3(mesh.faceNormal(i)));
}

TEST(ComputeNormals, WeighsByAngleNotByNumberOfTriangles)
{
    // A roof edge: one triangle on the left, the same angle cut into three on the right.
    const GroundMesh mesh = meshes::soup({{0, 0, 0},
                                          {0, 0, 1},
                                          {-1, -0.3, 0},
                                          {0.25, -0.075, 0.75},
                                          {0.5, -0.15, 0.5},
                                          {1, -0.3, 0}},
                                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 4}, {0, 4, 5}});
    const glm::vec3 ridge = mesh.normals[mesh.triangles[0].x];
    EXPECT_NEAR(ridge.x, 0.0, 1e-6);
    EXPECT_GT(ridge.y, 0.9);
}

TEST(ComputeNormals, SmoothsAcrossVerticesThatOnlyShareAPosition)
{
    // Two slanting triangles that meet in an edge, with vertices of their own.
    const GroundMesh mesh =
        meshes::soup({{0, 0, 0}, {0, 0, 1}, {-1, -0.3, 0}, {0, 0, 0}, {0, 0, 1}, {1, -0.3, 0}},
                     {{0, 2, 1}, {3, 4, 5}});
    EXPECT_EQ(mesh.normals[mesh.triangles[0].x], mesh.normals[mesh.triangles[1].x]);
    EXPECT_NEAR(mesh.normals[mesh.triangles[0].x].x, 0.0, 1e-6);
}

TEST(ComputeNormals, GivesBothSidesOfASheetTheirOwn)
{
    const GroundMesh mesh = meshes::soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 1}});
    EXPECT_EQ(mesh.normals[mesh.triangles[0].x], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[mesh.triangles[1].x], glm::vec3(0, -1, 0));
}

TEST(ComputeNormals, IsUnitEverywhereOnABookAndAMoebiusStrip)
{
    for (const GroundMesh& mesh : {meshes::book(), meshes::moebius()})
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (glm::length_t c = 0; c < 3; ++c) {
                const glm::dvec3 normal(mesh.normals[mesh.triangles[i][c]]);
                EXPECT_NEAR(glm::length(normal), 1.0, 1e-6);
                EXPECT_GT(glm::dot(normal, mesh.faceNormal(i)), 0.7);
            }
}

TEST(ComputeNormals, HasTheSameBitsForAnyNumberOfThreads)
{
    std::vector<GroundMesh> results;
    for (const std::size_t threads : {1U, 2U, 7U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        GroundMesh mesh = makeArch();
        computeNormals(mesh, analyse(mesh));
        results.push_back(std::move(mesh));
    }
    for (const GroundMesh& other : results) {
        EXPECT_EQ(other.normals, results[0].normals);
        EXPECT_EQ(other.triangles, results[0].triangles);
    }
}

TEST(ComputeNormals, TurnsWithTheMesh)
{
    const glm::dquat turn = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, 3)));
    GroundMesh mesh = meshes::sphere(16);
    GroundMesh turned = meshes::rotated(mesh, turn);
    computeNormals(mesh, analyse(mesh));
    computeNormals(turned, analyse(turned));
    ASSERT_EQ(mesh.normals.size(), turned.normals.size());
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        EXPECT_LT(glm::length(turn * glm::dvec3(mesh.normals[i]) - glm::dvec3(turned.normals[i])),
                  1e-5);
}

} // namespace
} // namespace sward::terrain
