#include "core/error.h"
#include "support/meshes.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::terrain {
namespace {

// A unit cube with welded corners and radial normals, so that both can be followed through
// transforms.
GlbBuilder cubeGlb(bool withNormals = true)
{
    const GroundMesh cube = meshes::cube();
    GlbBuilder builder;
    std::vector<float> positions;
    std::vector<float> normals;
    for (std::size_t i = 0; i < cube.positions.size(); ++i)
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            positions.push_back(cube.positions[i][axis]);
            normals.push_back(cube.normals[i][axis]);
        }
    std::vector<std::uint32_t> indices;
    for (const glm::uvec3& t : cube.triangles)
        indices.insert(indices.end(), {t.x, t.y, t.z});
    nlohmann::json primitive;
    primitive["attributes"]["POSITION"] = builder.floats(positions, "VEC3");
    if (withNormals)
        primitive["attributes"]["NORMAL"] = builder.floats(normals, "VEC3");
    primitive["indices"] = builder.words(indices, "SCALAR");
    builder.mesh(primitive);
    return builder;
}

// Faces and vertex normals agree, and both look outward.
void expectOutward(const GroundMesh& mesh)
{
    EXPECT_GT(meshes::signedVolume(mesh), 0.0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(
                glm::dot(mesh.faceNormal(i), glm::dvec3(mesh.normals[mesh.triangles[i][c]])), 1.0,
                1e-6)
                << "triangle " << i;
}

TEST(GltfTransform, KeepsFacesAndNormalsOutwardUnderAMirror)
{
    for (const bool withNormals : {true, false}) {
        GlbBuilder builder = cubeGlb(withNormals);
        builder.node({{"mesh", 0}, {"scale", {-1, 1, 1}}});
        const GroundMesh mesh = loadContent("a.glb", builder.glb());
        EXPECT_NEAR(meshes::signedVolume(mesh), 8.0, 1e-6);
        expectOutward(mesh);
    }
}

// The faces are turned before they are scaled: normals along the axes of the scale would keep their
// directions under the matrix itself, too.
TEST(GltfTransform, KeepsNormalsUprightUnderUnevenScale)
{
    GlbBuilder builder = cubeGlb();
    builder.node(
        {{"mesh", 0}, {"rotation", {0.1825741858, 0.3651483717, 0.5477225575, 0.7302967433}}});
    builder.node({{"children", {0}}, {"scale", {3, 0.5, -2}}});
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_NEAR(meshes::signedVolume(mesh), 8.0 * 3.0, 1e-4);
    expectOutward(mesh);
}

TEST(GltfTransform, TwoMirrorsAreNone)
{
    GlbBuilder builder = cubeGlb();
    builder.node({{"mesh", 0}, {"scale", {1, 1, -1}}});
    builder.node({{"children", {0}}, {"scale", {1, -1, 1}}});
    expectOutward(loadContent("a.glb", builder.glb()));
}

TEST(GltfTransform, NestsFromTheRootOutward)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["translation"] = {1, 0, 0};
    // Scale, then a quarter turn about Y, then a shift: (1, 0, 0) → (2, 0, 0) → (0, 0, −2) → (10,
    // 0, −2).
    builder.node({{"name", "parent"},
                  {"children", {0}},
                  {"scale", {2, 2, 2}},
                  {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                  {"translation", {10, 0, 0}}});
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_EQ(mesh.nodes[0], "parent/patch");
    const glm::dvec3 first = worldPosition(mesh, mesh.triangles[0].x);
    EXPECT_NEAR(glm::length(first - glm::dvec3(10, 0, -2)), 0.0, 1e-6);
}

TEST(GltfTransform, ReadsAMatrixByColumns)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["matrix"] = {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 10, 20, 30, 1};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    // (1, 0, 0) goes to (10, 20, 28).
    const glm::dvec3 second = worldPosition(mesh, mesh.triangles[0].y);
    EXPECT_NEAR(glm::length(second - glm::dvec3(10, 20, 28)), 0.0, 1e-6);
    EXPECT_GT(mesh.faceNormal(0).y, 0.99);
}

TEST(GltfTransform, KeepsATenthOfAMillimetreAMillionMetresAway)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["translation"] = {1000000.0001, -0.0002, -3000000.0003};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    const glm::dvec3 first = worldPosition(mesh, mesh.triangles[0].x);
    EXPECT_NEAR(first.x, 1000000.0001, 2e-6);
    EXPECT_NEAR(first.y, -0.0002, 2e-6);
    EXPECT_NEAR(first.z, -3000000.0003, 2e-6);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(std::fmod(mesh.origin[axis], 32.0), 0.0);
        EXPECT_LE(std::fabs(static_cast<double>(mesh.positions[0][axis])), 17.0);
    }
}

TEST(GltfTransform, AppliesInstancesOfANode)
{
    GlbBuilder builder = triangleGlb();
    const int shifts = builder.floats({1, 0, 0, 2, 0, 0, 3, 0, 0}, "VEC3");
    builder.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                    ["TRANSLATION"] = shifts;
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    ASSERT_EQ(mesh.triangles.size(), 3U);
    EXPECT_EQ(mesh.nodes.size(), 1U);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(worldPosition(mesh, mesh.triangles[i].x).x, 1.0 + static_cast<double>(i), 1e-6);
}

TEST(GltfTransform, NamesANodeWhoseTransformIsNotFinite)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["scale"] = {1e300, 1, 1};
    builder.node({{"children", {0}}, {"scale", {1e300, 1, 1}}});
    try {
        loadContent("a.glb", builder.glb());
        FAIL() << "an infinite position was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), testing::HasSubstr("patch"));
    }
}

} // namespace
} // namespace sward::terrain
