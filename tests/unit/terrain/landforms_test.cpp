#include "support/meshes.h"
#include "terrain/load.h"
#include "terrain/procedural/landforms.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/topology.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::terrain {
namespace {

TEST(Heightfield, HasTheNormalsOfItsFunction)
{
    // A paraboloid: central differences of a quadratic are exact inside the grid.
    const GroundMesh mesh = heightfield({glm::dvec2(4.0), glm::uvec2(16U)}, [](double x, double z) {
        return 0.1 * x * x - 0.2 * z * z;
    });
    int inside = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p(mesh.positions[i]);
        if (std::fabs(p.x) > 1.9 || std::fabs(p.z) > 1.9)
            continue;
        const glm::dvec3 exact = glm::normalize(glm::dvec3(-0.2 * p.x, 1.0, 0.4 * p.z));
        EXPECT_LT(glm::length(glm::dvec3(mesh.normals[i]) - exact), 1e-6);
        ++inside;
    }
    EXPECT_EQ(inside, 15 * 15);
}

TEST(Heightfield, FacesUpAndCoversItsExtent)
{
    const GroundMesh mesh =
        heightfield({glm::dvec2(6.0, 2.0), glm::uvec2(3U, 5U)}, [](double x, double) { return x; });
    EXPECT_EQ(mesh.triangles.size(), 30U);
    EXPECT_NEAR(meshes::totalArea(mesh), 12.0 * std::sqrt(2.0), 1e-5);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        EXPECT_GT(mesh.faceNormal(i).y, 0.7);
    EXPECT_EQ(mesh.uvs.front(), glm::vec2(0.0f));
    EXPECT_EQ(mesh.uvs.back(), glm::vec2(1.0f));
}

TEST(Heightfield, KeepsAPlaneStraightToTheBorder)
{
    const GroundMesh mesh = heightfield({glm::dvec2(4.0), glm::uvec2(4U)},
                                        [](double x, double z) { return 0.5 * x + 0.25 * z; });
    const glm::dvec3 exact = glm::normalize(glm::dvec3(-0.5, 1.0, -0.25));
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_LT(glm::length(glm::dvec3(normal) - exact), 1e-6);
}

TEST(Hills, RollWithinTheirHeight)
{
    const HillsSettings settings;
    const GroundMesh mesh = makeHills(settings);
    const Aabb box = mesh.bounds();
    EXPECT_GT(box.size().y, 0.2f * static_cast<float>(settings.height));
    EXPECT_LT(std::fabs(box.high.y), settings.height);
    EXPECT_EQ(analyse(mesh).components, 1U);
    EXPECT_NE(contentHash(mesh), contentHash(makeHills({.seed = 2})));
}

TEST(Dunes, AreSteeperInTheLee)
{
    const GroundMesh mesh = makeDunes();
    double rising = 0.0;
    double falling = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 normal = mesh.faceNormal(i);
        const double steepness = -normal.x / normal.y;
        (steepness > 0.0 ? rising : falling) =
            std::fmax(steepness > 0.0 ? rising : falling, std::fabs(steepness));
    }
    EXPECT_GT(falling, 1.5 * rising);
}

TEST(Arch, IsAClosedBodyOverOpenGround)
{
    const GroundMesh mesh = makeArch();
    ASSERT_EQ(mesh.nodes.size(), 2U);
    GroundMesh rock = mesh;
    rock.triangles.clear();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (mesh.nodes[mesh.nodeOf[i]] == "arch")
            rock.triangles.push_back(mesh.triangles[i]);
    rock.materialOf.resize(rock.triangles.size());
    rock.nodeOf.resize(rock.triangles.size());
    rock.bears.resize(rock.triangles.size());
    const Topology topology = analyse(rock);
    EXPECT_EQ(topology.borderEdgeCount, 0U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.nonManifoldEdgeCount, 0U);
    EXPECT_GT(meshes::signedVolume(rock), 20.0);
}

TEST(Arch, CoversGroundThatIsFreeBelowIt)
{
    const GroundMesh mesh = makeArch();
    const SurfaceQuery query(mesh);
    const SurfaceQuery::Nearest ground = query.nearest({0, -1, 0});
    EXPECT_EQ(mesh.nodes[mesh.nodeOf[ground.triangle]], "ground");
    const double height = query.clearance(ground.point, {0, 1, 0}, 20.0, ground.triangle);
    EXPECT_GT(height, 2.0);
    EXPECT_LT(height, 5.0);
    EXPECT_EQ(query.clearance({0, 1, 9}, {0, 1, 0}, 20.0, 0), 20.0);
}

} // namespace
} // namespace sward::terrain
