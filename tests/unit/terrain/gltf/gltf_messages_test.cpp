// What is said of files that are odd or wrong, in words of our own.

#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

namespace sward::terrain {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string refusal(const GlbBuilder& builder, ErrorKind kind = ErrorKind::input)
{
    try {
        loadContent("a.glb", builder.glb());
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.what();
    }
    return "it was read";
}

TEST(GltfMessages, SchemesAndTheirPartsHaveNoLetterCase)
{
    const std::string plain = triangleGlb().gltf();
    for (const auto& [from, to] : {std::pair("data:", "DATA:"), std::pair("data:", "Data:"),
                                   std::pair(";base64", ";BASE64")}) {
        std::string text = plain;
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos);
        text.replace(at, std::string(from).size(), to);
        EXPECT_EQ(loadContent("a.gltf", text).triangles.size(), 1U) << to;
    }
}

TEST(GltfMessages, ObjectsInThePlaceOfArraysAreVersion1OnlyWithoutAnotherVersion)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"] = nlohmann::json::object();
    EXPECT_THAT(refusal(builder), HasSubstr("nodes is not an array"));
    builder.document["asset"].erase("version");
    EXPECT_THAT(refusal(builder, ErrorKind::unsupported), HasSubstr("glTF version 1"));
    builder.document["asset"]["version"] = "1.1";
    EXPECT_THAT(refusal(builder, ErrorKind::unsupported), HasSubstr("glTF version 1"));
}

TEST(GltfMessages, TellsOfSparseIndicesThatDoNotRise)
{
    for (const std::uint8_t second : std::vector<std::uint8_t>{0, 1, 2}) {
        GlbBuilder builder = triangleGlb();
        const std::uint8_t where[4] = {1, second, 0, 0};
        const float what[6] = {2, 0, 0, 3, 0, 0};
        const int indices = builder.view(where, sizeof where);
        const int values = builder.view(what, sizeof what);
        auto& document = builder.document;
        const auto position =
            document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
        document["accessors"][position]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
            {"values", {{"bufferView", values}}}};
        Diagnostics diagnostics;
        try {
            loadContent("a.glb", builder.glb(), {}, &diagnostics);
        } catch (const Error&) {
            // Moved corners may leave no ground.
        }
        if (second > 1)
            EXPECT_THAT(diagnostics.warnings(), Not(Contains(HasSubstr("sparse indices"))));
        else
            EXPECT_THAT(diagnostics.warnings(),
                        Contains(HasSubstr(fmt::format("entry 1 names element {} after 1",
                                                       int(second)))));
    }
}

TEST(GltfMessages, TakesFilesOfNearlyTheNameWithAWarning)
{
    GlbBuilder builder = triangleGlb();
    nlohmann::json document = nlohmann::json::parse(builder.gltf());
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path("Parts"));
    folder.write("Parts/Mesh.bin", builder.binary());
    for (const char* uri : {"Parts\\Mesh.bin", "parts/mesh.BIN", "PARTS\\mesh.bin",
                            "Parts/Mesh.bin", "Parts%5Cmesh.bin"}) {
        document["buffers"][0]["uri"] = uri;
        const std::string path = folder.write("a.gltf", document.dump());
        Diagnostics diagnostics;
        EXPECT_EQ(load(path, {}, diagnostics).triangles.size(), 1U) << uri;
        if (std::string(uri) == "Parts/Mesh.bin")
            EXPECT_THAT(diagnostics.warnings(), IsEmpty());
        else
            EXPECT_THAT(diagnostics.warnings(),
                        ElementsAre(AllOf(HasSubstr("buffer 0"), HasSubstr("Mesh.bin is taken"))));
    }
    document["buffers"][0]["uri"] = "Parts/Mehs.bin";
    const std::string path = folder.write("a.gltf", document.dump());
    try {
        Diagnostics diagnostics;
        load(path, {}, diagnostics);
        FAIL() << "a file that is not there was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_THAT(error.what(), HasSubstr("did you mean Mesh.bin?"));
    }
}

TEST(GltfMessages, TellsOfRestartValuesAmongTheIndices)
{
    const std::vector<std::uint8_t> bytes = {0, 1, 255};
    for (const int mode : {4, 5, 6})
        for (const bool isThere : {false, true}) {
            GlbBuilder builder;
            std::vector<float> positions;
            for (int i = 0; i < (isThere ? 256 : 255); ++i)
                positions.insert(positions.end(), {float(i % 16), 0, -float(i / 16)});
            nlohmann::json primitive;
            primitive["attributes"]["POSITION"] = builder.floats(positions, "VEC3");
            primitive["indices"] = builder.bytes(bytes, "SCALAR");
            primitive["mode"] = mode;
            builder.mesh(primitive);
            builder.node({{"mesh", 0}});
            if (isThere) {
                Diagnostics diagnostics;
                loadContent("a.glb", builder.glb(), {}, &diagnostics);
                EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("restart value")));
            } else {
                EXPECT_THAT(refusal(builder),
                            AllOf(HasSubstr("index 2 names vertex 255"), HasSubstr("restart")));
            }
        }
    // 255 is an index like others where the indices have more bits.
    GlbBuilder wide;
    std::vector<float> positions;
    for (int i = 0; i < 256; ++i)
        positions.insert(positions.end(), {float(i % 16), 0, -float(i / 16)});
    nlohmann::json primitive;
    primitive["attributes"]["POSITION"] = wide.floats(positions, "VEC3");
    primitive["indices"] = wide.shorts({0, 1, 255}, "SCALAR");
    wide.mesh(primitive);
    wide.node({{"mesh", 0}});
    Diagnostics diagnostics;
    loadContent("a.glb", wide.glb(), {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(GltfMessages, NamesWhatIsMissingAndNothingElse)
{
    GlbBuilder scene = triangleGlb();
    scene.document["scenes"] = {{{"nodes", {0}}}};
    scene.document["scene"] = 3;
    EXPECT_THAT(refusal(scene), AllOf(HasSubstr("scene is 3"), HasSubstr("scenes end at 0"),
                                      Not(HasSubstr("document"))));
    GlbBuilder version = triangleGlb();
    version.document["asset"] = nlohmann::json::object();
    EXPECT_THAT(refusal(version), HasSubstr("its version is missing"));
    GlbBuilder empty = triangleGlb();
    empty.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 24}, {"byteLength", 0}});
    EXPECT_THAT(refusal(empty), HasSubstr("bufferView 3: byteLength is 0"));
    GlbBuilder views = triangleGlb();
    for (nlohmann::json& accessor : views.document["accessors"])
        accessor.erase("bufferView");
    views.document.erase("bufferViews");
    EXPECT_THAT(refusal(views), HasSubstr("accessor 0 has no bufferView"));
    GlbBuilder flat = triangleGlb();
    flat.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        flat.floats({0, 0, 1, 0, 0, -1}, "VEC2");
    EXPECT_THAT(refusal(flat), HasSubstr("POSITION: its elements have 2 numbers, not 3"));
    GlbBuilder dangling = triangleGlb();
    dangling.document.erase("bufferViews");
    EXPECT_THAT(refusal(dangling), HasSubstr("bufferView is 0, but the file has no bufferViews"));
}

TEST(GltfMessages, AnEmptySceneNamesOneThatIsNot)
{
    GlbBuilder builder = triangleGlb();
    builder.document["scenes"] = {nlohmann::json::object(), {{"nodes", {0}}}};
    EXPECT_THAT(refusal(builder), HasSubstr("scene 1 shows 1: try --scene 1"));
    EXPECT_EQ(loadContent("a.glb", builder.glb(), {.scene = 1}).triangles.size(), 1U);
    builder.document["scenes"] = {nlohmann::json::object(), nlohmann::json::object()};
    EXPECT_THAT(refusal(builder), AllOf(HasSubstr("no triangles"), HasSubstr("none of its 2")));
}

TEST(GltfMessages, ANodeIsPlacedByAParentThatItsSceneDoesNotName)
{
    GlbBuilder builder = triangleGlb();
    builder.node({{"children", {0}}, {"translation", {0, 5, 0}}});
    builder.node({{"children", {1}}, {"translation", {7, 0, 0}}, {"name", "top"}});
    builder.document["scenes"] = {{{"nodes", {0}}}};
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
    EXPECT_EQ(worldPosition(mesh, mesh.triangles[0].x), glm::dvec3(7, 5, 0));
    EXPECT_EQ(mesh.nodes[0], "top/node 1/patch");
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("names node 0, and not node 1")));
}

TEST(GltfMessages, SaysThatAMatrixWinsOverItsParts)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1};
    builder.document["nodes"][0]["scale"] = {2, 2, 2};
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
    EXPECT_DOUBLE_EQ(mesh.area(0), 0.5);
    EXPECT_EQ(worldPosition(mesh, mesh.triangles[0].x), glm::dvec3(3, 0, 0));
    EXPECT_THAT(diagnostics.warnings(),
                ElementsAre(AllOf(HasSubstr("node 0"), HasSubstr("matrix and a scale"))));
}

// Bounds that a header alone cannot exceed: a few bytes that claim much.
TEST(GltfMessages, ClaimsWithoutBytesAreRefused)
{
    GlbBuilder zeros = triangleGlb();
    zeros.document["accessors"][1].erase("bufferView");
    zeros.document["accessors"][1]["count"] = 1 << 20;
    EXPECT_THAT(refusal(zeros), HasSubstr("1048576 elements, but no bufferView"));

    // Instances without a place, of a node with a long name.
    GlbBuilder instances = triangleGlb();
    instances.document["nodes"][0]["name"] = std::string(3000, 'n');
    instances.document["accessors"].push_back(
        {{"componentType", 5126}, {"type", "VEC3"}, {"count", 60'000}});
    instances.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                      ["TRANSLATION"] = 3;
    EXPECT_THAT(refusal(instances), HasSubstr("more instances than a file of"));
}

} // namespace
} // namespace sward::terrain
