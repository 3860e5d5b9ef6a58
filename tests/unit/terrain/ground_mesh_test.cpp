#include "core/error.h"
#include "support/meshes.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/soup.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

TEST(GroundMesh, MeasuresATriangle)
{
    const GroundMesh mesh = meshes::triangle();
    EXPECT_DOUBLE_EQ(mesh.area(0), 0.5);
    EXPECT_EQ(mesh.faceNormal(0), glm::dvec3(0, 1, 0));
    EXPECT_EQ(meshes::areaRatioPair().area(0), 1000.0 * meshes::areaRatioPair().area(1));
}

TEST(GroundMesh, HasItsOriginOnTheGridNearItsMiddle)
{
    DAabb box;
    box.add({-3.0, -10.0, 100.0});
    box.add({5.0, 12.0, 140.0});
    EXPECT_EQ(originFor(box), glm::dvec3(0, 0, 128));
    for (const double far : {1e6, -123456.789, 1e9}) {
        DAabb there;
        there.add(glm::dvec3(far));
        const glm::dvec3 origin = originFor(there);
        EXPECT_EQ(std::fmod(origin.x, 32.0), 0.0);
        EXPECT_LE(std::fabs(origin.x - far), 16.0);
    }
}

TEST(Validate, AcceptsEveryTestMesh)
{
    for (const GroundMesh& mesh :
         {meshes::triangle(), meshes::square(), meshes::cube(), meshes::areaRatioPair(),
          meshes::sphere(), meshes::book(), meshes::moebius(), meshes::boxAbovePlane()})
        EXPECT_NO_THROW(validate(mesh, "mesh"));
}

TEST(Validate, RefusesEveryWayToBeWrong)
{
    const auto expectWrong = [](void (*spoil)(GroundMesh&)) {
        GroundMesh mesh = meshes::square();
        spoil(mesh);
        try {
            validate(mesh, "the place");
            ADD_FAILURE() << "was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_EQ(std::string(error.what()).rfind("the place", 0), 0U) << error.what();
        }
    };
    expectWrong([](GroundMesh& m) { m.triangles[0].y = 4; });
    expectWrong([](GroundMesh& m) { m.materialOf[1] = 1; });
    expectWrong([](GroundMesh& m) { m.nodeOf[1] = 7; });
    expectWrong([](GroundMesh& m) { m.normals.pop_back(); });
    expectWrong([](GroundMesh& m) { m.uvs.emplace_back(0.0f); });
    expectWrong([](GroundMesh& m) { m.colors.clear(); });
    expectWrong([](GroundMesh& m) { m.bears.clear(); });
    expectWrong([](GroundMesh& m) { m.positions[2].z = std::numeric_limits<float>::infinity(); });
    expectWrong([](GroundMesh& m) { m.normals[2].z = std::numeric_limits<float>::quiet_NaN(); });
    expectWrong([](GroundMesh& m) { m.uvs[0].x = std::numeric_limits<float>::quiet_NaN(); });
    expectWrong([](GroundMesh& m) {
        m.triangles.clear();
        m.materialOf.clear();
        m.nodeOf.clear();
        m.bears.clear();
    });
    expectWrong([](GroundMesh& m) {
        for (glm::vec3& p : m.positions)
            p.x = 0.0f;
    });
}

TEST(Append, BringsGroundToOneOrigin)
{
    GroundMesh mesh = meshes::moved(meshes::square(), {1e6, 0, 0});
    const GroundMesh other = meshes::moved(meshes::cube(), {1e6 + 100.25, 3.0, 0});
    append(mesh, other);
    EXPECT_NO_THROW(validate(mesh, "both"));
    EXPECT_EQ(mesh.triangles.size(), 14U);
    EXPECT_EQ(mesh.materialOf.back(), 1U);
    EXPECT_EQ(mesh.nodeOf.back(), 1U);
    DAabb box;
    for (std::size_t i = 4; i < mesh.positions.size(); ++i)
        box.add(worldPosition(mesh, i));
    EXPECT_EQ(box.centre(), glm::dvec3(1e6 + 100.25, 3.0, 0.0));
}

TEST(Settle, DropsVerticesWithoutATriangle)
{
    const GroundMesh mesh =
        meshes::soup({{9e9, 0, 0}, {0, 0, 0}, {0, 0, 1}, {-5e9, 0, 0}, {1, 0, 0}}, {{1, 2, 4}});
    EXPECT_EQ(mesh.positions.size(), 3U);
    EXPECT_EQ(mesh.origin, glm::dvec3(0.0));
}

TEST(Rotated, TurnsPositionsAndNormalsTogether)
{
    const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, -2, 3)));
    const GroundMesh mesh = meshes::cube();
    const GroundMesh turned = meshes::rotated(mesh, turn);
    ASSERT_EQ(turned.positions.size(), mesh.positions.size());
    EXPECT_EQ(turned.triangles, mesh.triangles);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_LT(glm::length(turn * glm::dvec3(mesh.positions[i]) - worldPosition(turned, i)),
                  1e-6);
        EXPECT_LT(glm::length(turn * glm::dvec3(mesh.normals[i]) - glm::dvec3(turned.normals[i])),
                  1e-6);
    }
}

} // namespace
} // namespace sward::terrain
