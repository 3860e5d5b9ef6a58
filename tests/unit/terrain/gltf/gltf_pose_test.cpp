// Skins and morph targets at rest, as glTF 2.0 defines the pose before any animation.

#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::terrain {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// By columns.
std::vector<float> moved(float x, float y, float z, float scale = 1.0f)
{
    return {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, x, y, z, 1};
}

std::vector<float> joined(std::vector<std::vector<float>> lists)
{
    std::vector<float> all;
    for (const std::vector<float>& list : lists)
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

// The triangle (0,0,0) (1,0,0) (0,0,-1) that follows two joints: nodes 1 and 2.
struct Skinned {
    explicit Skinned(const std::vector<float>& weights = {1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0},
                     const std::vector<std::uint8_t>& joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0})
    {
        auto& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
        attributes["JOINTS_0"] = builder.bytes(joints, "VEC4");
        attributes["WEIGHTS_0"] = builder.floats(weights, "VEC4");
        builder.document["nodes"][0]["skin"] = 0;
        builder.document["nodes"][0]["translation"] = {100, 200, 300};
        builder.node({{"translation", {0, 2, 0}}});
        builder.node({{"translation", {4, 0, 0}}});
        builder.document["skins"] = {{{"joints", {1, 2}}}};
    }

    void bind(const std::vector<float>& matrices)
    {
        builder.document["skins"][0]["inverseBindMatrices"] = builder.floats(matrices, "MAT4");
    }

    GroundMesh load(Diagnostics* diagnostics = nullptr) const
    {
        return loadContent("a.glb", builder.glb(), {}, diagnostics);
    }

    GlbBuilder builder = triangleGlb();
};

void expectCorners(const GroundMesh& mesh, const std::vector<glm::dvec3>& corners)
{
    ASSERT_EQ(mesh.triangles.size() * 3, corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 own = worldPosition(mesh, mesh.triangles[i / 3][int(i % 3)]);
        EXPECT_NEAR(glm::length(own - corners[i]), 0.0, 1e-5)
            << i << ": " << own.x << " " << own.y << " " << own.z;
    }
}

std::string messageOf(const GlbBuilder& builder)
{
    try {
        loadContent("a.glb", builder.glb());
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
        return error.what();
    }
    return "it was read";
}

TEST(GltfPose, JointsPlaceASkinnedMeshAndItsNodeDoesNot)
{
    Diagnostics diagnostics;
    expectCorners(Skinned().load(&diagnostics), {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}});
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(GltfPose, InverseBindMatricesComeBeforeTheJoints)
{
    Skinned skinned;
    skinned.bind(joined({moved(1, 0, 0), moved(0, 0, 0, 0.5f)}));
    expectCorners(skinned.load(), {{1, 2, 0}, {4.5, 0, 0}, {2.5, 1, -0.75}});
    // Those of the pose in which the mesh was bound give back its own places.
    Skinned bound;
    bound.bind(joined({moved(0, -2, 0), moved(-4, 0, 0)}));
    expectCorners(bound.load(), {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}});
}

TEST(GltfPose, JointsStandWhereTheirParentsPutThem)
{
    Skinned skinned;
    // A quarter turn about Y, and twice the size: (x, y, z) → 2 (z, y, −x).
    skinned.builder.node({{"children", {1, 2}},
                          {"scale", {2, 2, 2}},
                          {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
    expectCorners(skinned.load(), {{0, 4, 0}, {0, 0, -10}, {-2, 2, -4}});
}

TEST(GltfPose, NormalsAndFrontsFollowTheJoints)
{
    Skinned skinned({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    skinned.builder.document["nodes"][1] = {{"scale", {1, 1, -3}},
                                            {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}};
    const GroundMesh mesh = skinned.load();
    // The front looks up before, along z after the quarter turn about X. The mirror keeps it.
    EXPECT_NEAR(mesh.area(0), 1.5, 1e-6);
    EXPECT_NEAR(glm::dot(mesh.faceNormal(0), glm::dvec3(mesh.normals[0])), 1.0, 1e-6);
    EXPECT_NEAR(mesh.normals[0].z, 1.0, 1e-6);
}

TEST(GltfPose, WeightsAreSharesOfTheirSum)
{
    Skinned uneven({2, 0, 0, 0, 0, 0.25f, 0, 0, 3, 3, 0, 0});
    Diagnostics diagnostics;
    expectCorners(uneven.load(&diagnostics), {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}});
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("3 vertices do not add up to 1")));

    Skinned none({0, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0});
    Diagnostics warned;
    expectCorners(none.load(&warned), {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}});
    EXPECT_THAT(warned.warnings(), Contains(HasSubstr("1 vertices have no weight")));

    // Whole numbers, normalised, in a second set as well.
    Skinned sets({1, 0, 0, 0, 0, 1, 0, 0, 0.25f, 0.25f, 0, 0});
    auto& attributes = sets.builder.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = sets.builder.shorts({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] =
        sets.builder.bytes({0, 0, 0, 0, 0, 0, 0, 0, 64, 64, 0, 0}, "VEC4", true);
    expectCorners(sets.load(), {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}});
}

TEST(GltfPose, NamesWhatIsWrongWithASkin)
{
    EXPECT_THAT(messageOf(Skinned({1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0},
                                  {0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0})
                              .builder),
                HasSubstr("vertex 1 follows joint 2, but its skin has 2"));
    EXPECT_THAT(messageOf(Skinned({1, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0}).builder),
                HasSubstr("WEIGHTS_0 of vertex 1 is -1"));
    Skinned halves;
    halves.builder.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_THAT(messageOf(halves.builder), HasSubstr("it has JOINTS_0 and no WEIGHTS_0"));
    Skinned few;
    few.bind(moved(0, 0, 0));
    EXPECT_THAT(messageOf(few.builder), HasSubstr("skin 0: 1 inverseBindMatrices for 2 joints"));
    Skinned astray;
    astray.builder.document["skins"][0]["joints"] = {1, 7};
    EXPECT_THAT(messageOf(astray.builder), HasSubstr("joints names 7"));
}

TEST(GltfPose, RefusesMoreWeightsThanTheFileAllows)
{
    // Zeros that no byte of the file stands for.
    Skinned skinned;
    auto& document = skinned.builder.document;
    constexpr int vertices = 60000;
    const auto zeros = [&](int type, const char* shape) {
        document["accessors"].push_back(
            {{"componentType", type}, {"type", shape}, {"count", vertices}});
        return document["accessors"].size() - 1;
    };
    auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    const std::uint8_t where[4] = {0, 0, 0, 0};
    const float what[3] = {0, 0, 0};
    const int indices = skinned.builder.view(where, sizeof where);
    const int values = skinned.builder.view(what, sizeof what);
    const auto positions = zeros(5126, "VEC3");
    document["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
        {"values", {{"bufferView", values}}}};
    const auto joints = zeros(5121, "VEC4");
    const auto weights = zeros(5126, "VEC4");
    attributes = {{"POSITION", positions}};
    for (int set = 0; set < 40; ++set) {
        attributes[fmt::format("JOINTS_{}", set)] = joints;
        attributes[fmt::format("WEIGHTS_{}", set)] = weights;
    }
    EXPECT_THAT(messageOf(skinned.builder),
                HasSubstr("JOINTS_0 to JOINTS_17 give 4320000 weights to its 60000 vertices"));
}

TEST(GltfPose, JointsAreUnsignedBytesOrShortsThatAreNotNormalized)
{
    Skinned normalized;
    const auto attributesOf = [](Skinned& skinned) -> auto& {
        return skinned.builder.document["meshes"][0]["primitives"][0]["attributes"];
    };
    attributesOf(normalized)["JOINTS_0"] =
        normalized.builder.bytes({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", true);
    EXPECT_THAT(messageOf(normalized.builder), HasSubstr("5121, normalized, but joints are"));
    Skinned floats;
    attributesOf(floats)["JOINTS_0"] =
        floats.builder.floats({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    EXPECT_THAT(messageOf(floats.builder), HasSubstr("component type 5126, but joints are"));
    Skinned bytes;
    bytes.builder.document["accessors"][attributesOf(bytes)["JOINTS_0"].get<std::size_t>()]
                          ["componentType"] = 5120;
    EXPECT_THAT(messageOf(bytes.builder), HasSubstr("component type 5120, but joints are"));
}

TEST(GltfPose, InverseBindMatricesAreNoProjections)
{
    std::vector<float> matrices = joined({moved(1, 0, 0), moved(0, 0, 0)});
    matrices[16 + 15] = 2;
    Skinned doubled;
    doubled.bind(matrices);
    EXPECT_THAT(messageOf(doubled.builder),
                HasSubstr("element 15 of the inverse bind matrix of joint 1 is 2"));
    matrices[16 + 15] = 1.00001f; // rounding
    Skinned rounded;
    rounded.bind(matrices);
    expectCorners(rounded.load(), {{1, 2, 0}, {5, 0, 0}, {2.5, 1, -1}});
}

TEST(GltfPose, APrimitiveWithoutJointsIsPlacedByItsNode)
{
    Skinned skinned;
    skinned.builder.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    skinned.builder.document["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    Diagnostics diagnostics;
    expectCorners(skinned.load(&diagnostics), {{100, 200, 300}, {101, 200, 300}, {100, 200, 299}});
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("no JOINTS_0")));
}

TEST(GltfPose, InstancesOfASkinAreOne)
{
    Skinned skinned;
    skinned.builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                            ["TRANSLATION"] = skinned.builder.floats({1, 0, 0, 2, 0, 0}, "VEC3");
    Diagnostics diagnostics;
    expectCorners(skinned.load(&diagnostics), {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}});
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("EXT_mesh_gpu_instancing")));
}

TEST(GltfPose, TwoNodesMayPoseOneMeshDifferently)
{
    Skinned skinned;
    skinned.builder.node({{"mesh", 0}, {"translation", {0, 0, 10}}});
    expectCorners(skinned.load(),
                  {{0, 2, 0}, {5, 0, 0}, {2, 1, -1}, {0, 0, 10}, {1, 0, 10}, {0, 0, 9}});
}

// Two morph targets of the triangle: the first lifts its corners by 1, 2 and 3; the second moves
// the last along −z, by sparse differences.
GlbBuilder morphGlb()
{
    GlbBuilder builder = triangleGlb();
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    const int lift = builder.floats({0, 1, 0, 0, 2, 0, 0, 3, 0}, "VEC3");
    const std::uint8_t where[4] = {2, 0, 0, 0};
    const float what[3] = {0, 0, -4};
    const int indices = builder.view(where, sizeof where);
    const int values = builder.view(what, sizeof what);
    builder.document["accessors"].push_back(
        {{"componentType", 5126},
         {"type", "VEC3"},
         {"count", 3},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
           {"values", {{"bufferView", values}}}}}});
    primitive["targets"] = {{{"POSITION", lift}},
                            {{"POSITION", builder.document["accessors"].size() - 1}}};
    return builder;
}

TEST(GltfPose, DefaultWeightsOfAMeshMorphIt)
{
    GlbBuilder builder = morphGlb();
    expectCorners(loadContent("a.glb", builder.glb()), {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}});
    builder.document["meshes"][0]["weights"] = {0.5, 0.25};
    Diagnostics diagnostics;
    expectCorners(loadContent("a.glb", builder.glb(), {}, &diagnostics),
                  {{0, 0.5, 0}, {1, 1, 0}, {0, 1.5, -2}});
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(GltfPose, WeightsOfANodeWinOverThoseOfItsMesh)
{
    GlbBuilder builder = morphGlb();
    builder.document["meshes"][0]["weights"] = {0.5, 0.25};
    builder.document["nodes"][0]["weights"] = {-1, 0};
    builder.node({{"mesh", 0}, {"translation", {0, 10, 0}}});
    expectCorners(loadContent("a.glb", builder.glb()),
                  {{0, -1, 0}, {1, -2, 0}, {0, -3, -1}, {0, 10.5, 0}, {1, 11, 0}, {0, 11.5, -2}});
}

TEST(GltfPose, MorphsReachNormalsColorsAndTextureCoordinates)
{
    GlbBuilder builder = triangleGlb();
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["attributes"]["COLOR_0"] = builder.floats({0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
    primitive["targets"] = {
        {{"NORMAL", builder.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3")},
         {"TEXCOORD_0", builder.floats({0.5f, 0, 0.5f, 0, 0.5f, 0}, "VEC2")},
         {"COLOR_0", builder.bytes({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}, "VEC4", true)}}};
    builder.document["meshes"][0]["weights"] = {0.5};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_NEAR(mesh.normals[0].x, 0.5 / std::sqrt(1.25), 1e-6);
    EXPECT_NEAR(mesh.uvs[0].x, 0.25, 1e-6);
    EXPECT_NEAR(mesh.colors[1].y, 0.5, 1e-6);
}

TEST(GltfPose, MorphedColorsAreCutOffAndNotDivided)
{
    GlbBuilder builder = triangleGlb();
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["COLOR_0"] =
        builder.floats({0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}, "VEC3");
    primitive["targets"] = {{{"COLOR_0", builder.floats({3, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
    builder.document["meshes"][0]["weights"] = {1};
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
    EXPECT_NEAR(mesh.colors[0].x, 1.0, 1e-6);
    EXPECT_NEAR(mesh.colors[0].y, 0.5, 1e-6);
    EXPECT_NEAR(mesh.colors[1].x, 0.5, 1e-6);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("cut off at 0 and 1")));
}

TEST(GltfPose, AMeshIsMorphedBeforeItIsSkinned)
{
    Skinned skinned({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    skinned.builder.document["nodes"][1] = {{"scale", {2, 2, 2}}};
    skinned.builder.document["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", skinned.builder.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")}}};
    skinned.builder.document["meshes"][0]["weights"] = {3};
    expectCorners(skinned.load(), {{0, 6, 0}, {2, 6, 0}, {0, 6, -2}});
}

TEST(GltfPose, NamesWhatIsWrongWithAMorph)
{
    GlbBuilder builder = morphGlb();
    builder.document["meshes"][0]["weights"] = {1};
    EXPECT_THAT(messageOf(builder), HasSubstr("mesh 0: 1 weights for 2 morph targets"));
    builder.document["meshes"][0]["weights"] = {1, 1};
    builder.document["nodes"][0]["weights"] = {1, 1, 1};
    EXPECT_THAT(messageOf(builder), HasSubstr("node 0: 3 weights for 2 morph targets"));
    builder.document["nodes"][0].erase("weights");
    builder.document["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
        builder.floats({0, 0, 0}, "VEC3");
    EXPECT_THAT(messageOf(builder), HasSubstr("POSITION of morph target 0"));
}

} // namespace
} // namespace sward::terrain
