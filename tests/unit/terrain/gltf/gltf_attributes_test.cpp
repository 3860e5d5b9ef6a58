#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

using testing::HasSubstr;

nlohmann::json& attributesOf(GlbBuilder& builder)
{
    return builder.document["meshes"][0]["primitives"][0]["attributes"];
}

TEST(GltfAttributes, MakesNormalsWhereTheFileHasNone)
{
    GlbBuilder builder = triangleGlb();
    attributesOf(builder).erase("NORMAL");
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_FALSE(mesh.hasNormals);
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

TEST(GltfAttributes, KeepsNormalsOfOnePrimitiveWhereAnotherHasNone)
{
    GlbBuilder builder = triangleGlb();
    const float slant = std::sqrt(0.5f);
    attributesOf(builder)["NORMAL"] =
        builder.floats({slant, slant, 0, slant, slant, 0, slant, slant, 0}, "VEC3");
    const int positions = builder.floats({0, 0, 5, 1, 0, 5, 0, 0, 4}, "VEC3");
    builder.primitive({{"attributes", {{"POSITION", positions}}}});
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_FALSE(mesh.hasNormals);
    EXPECT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.normals[mesh.triangles[0].x], glm::vec3(slant, slant, 0));
    EXPECT_EQ(mesh.normals[mesh.triangles[1].x], glm::vec3(0, 1, 0));
}

TEST(GltfAttributes, ReadsColorsOfEveryType)
{
    const auto colorOf = [](int (*add)(GlbBuilder&)) {
        GlbBuilder builder = triangleGlb();
        attributesOf(builder)["COLOR_0"] = add(builder);
        const GroundMesh mesh = loadContent("a.glb", builder.glb());
        EXPECT_TRUE(mesh.hasColors);
        return mesh.colors[1];
    };
    const auto expectNear = [](const glm::vec4& a, const glm::vec4& b) {
        EXPECT_NEAR(glm::length(glm::dvec4(a) - glm::dvec4(b)), 0.0, 1e-6);
    };
    expectNear(colorOf([](GlbBuilder& b) {
                   return b.floats({1, 1, 1, .25f, .5f, .75f, 0, 0, 0}, "VEC3");
               }),
               {.25f, .5f, .75f, 1});
    expectNear(colorOf([](GlbBuilder& b) {
                   return b.floats({1, 1, 1, 1, .25f, .5f, .75f, .125f, 0, 0, 0, 0}, "VEC4");
               }),
               {.25f, .5f, .75f, .125f});
    expectNear(colorOf([](GlbBuilder& b) {
                   return b.bytes({255, 255, 255, 255, 51, 102, 153, 204, 0, 0, 0, 0}, "VEC4",
                                  true);
               }),
               {.2f, .4f, .6f, .8f});
    expectNear(colorOf([](GlbBuilder& b) {
                   return b.shorts({0, 0, 0, 13107, 26214, 65535, 0, 0, 0}, "VEC3", true);
               }),
               {.2f, .4f, 1, 1});
}

TEST(GltfAttributes, ReadsTextureCoordinatesOfIntegers)
{
    GlbBuilder builder = triangleGlb();
    attributesOf(builder)["TEXCOORD_0"] = builder.bytes({0, 255, 51, 102, 0, 0}, "VEC2", true);
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0, 1));
    EXPECT_NEAR(mesh.uvs[1].x, 0.2, 1e-6);
}

TEST(GltfAttributes, ReadsQuantisedPositions)
{
    GlbBuilder builder = triangleGlb();
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    attributesOf(builder)["POSITION"] = builder.shorts({0, 0, 0, 1000, 0, 0, 0, 0, 500}, "VEC3");
    attributesOf(builder).erase("NORMAL");
    builder.document["nodes"][0]["scale"] = {0.001, 0.001, -0.002};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_NEAR(worldPosition(mesh, mesh.triangles[0].y).z +
                    worldPosition(mesh, mesh.triangles[0].z).z,
                -1.0, 1e-6);
    EXPECT_NEAR(mesh.area(0), 0.5, 1e-6);
}

TEST(GltfAttributes, ReadsInterleavedVertices)
{
    const std::vector<float> vertices = {0, 0, 0, 9, 1, 0, 0, 9, 0, 0, -1, 9};
    GlbBuilder builder;
    const int positions = builder.floats(vertices, "VEC3");
    builder.document["accessors"][0]["count"] = 3;
    builder.document["bufferViews"][0]["byteStride"] = 16;
    builder.mesh({{"attributes", {{"POSITION", positions}}}});
    builder.node({{"mesh", 0}});
    EXPECT_DOUBLE_EQ(loadContent("a.glb", builder.glb()).area(0), 0.5);
}

TEST(GltfAttributes, PutsSparseValuesInTheirPlace)
{
    GlbBuilder builder = triangleGlb();
    const std::vector<std::uint16_t> index = {1};
    const std::vector<float> value = {4, 0, 0};
    const int indexView = builder.view(index.data(), 2);
    const int valueView = builder.view(value.data(), 12);
    builder.document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
        {"values", {{"bufferView", valueView}}}};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_EQ(mesh.positions[1], glm::vec3(4, 0, 0));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, 0, -1));
}

TEST(GltfAttributes, NamesTheVertexWhosePositionIsNotANumber)
{
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GlbBuilder builder = triangleGlb();
        attributesOf(builder)["POSITION"] =
            builder.floats({0, 0, 0, 1, 0, 0, 0, wrong, -1}, "VEC3");
        try {
            loadContent("a.glb", builder.glb());
            FAIL() << "a position of " << wrong << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_THAT(error.what(), HasSubstr("POSITION of vertex 2"));
            EXPECT_THAT(error.what(), HasSubstr("mesh 0, primitive 0"));
        }
    }
}

TEST(GltfAttributes, RefusesIndicesAndCountsThatDoNotFit)
{
    GlbBuilder index = triangleGlb();
    index.document["meshes"][0]["primitives"][0]["indices"] = index.shorts({0, 1, 3}, "SCALAR");
    EXPECT_THROW(loadContent("a.glb", index.glb()), Error);

    GlbBuilder count = triangleGlb();
    attributesOf(count)["NORMAL"] = count.floats({0, 1, 0, 0, 1, 0}, "VEC3");
    EXPECT_THROW(loadContent("a.glb", count.glb()), Error);

    GlbBuilder type = triangleGlb();
    attributesOf(type)["POSITION"] = type.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    EXPECT_THROW(loadContent("a.glb", type.glb()), Error);
}

} // namespace
} // namespace sward::terrain
