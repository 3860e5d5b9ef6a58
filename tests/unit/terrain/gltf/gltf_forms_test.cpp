// glTF files that are valid but unusual, and those whose numbers no ground can have.

#include "core/error.h"
#include "support/meshes.h"
#include "terrain/reach.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sward::terrain {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::string gltfMessage(const GlbBuilder& builder, ErrorKind kind)
{
    try {
        loadContent("a.gltf", builder.gltf());
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "was read";
    return {};
}

// Each whole number as a float.
void writeFloats(json& value)
{
    if (value.is_structured())
        for (json& part : value)
            writeFloats(part);
    else if (value.is_number_integer())
        value = value.get<double>();
}

TEST(GltfForms, WholeNumbersMayBeWrittenAsFloats)
{
    GlbBuilder builder = triangleGlb();
    const GroundMesh mesh = loadContent("a.gltf", builder.gltf());
    json all = json::parse(builder.gltf());
    writeFloats(all);
    const GroundMesh same = loadContent("a.gltf", all.dump());
    EXPECT_EQ(contentHash(same), contentHash(mesh));
    all["accessors"][0]["count"] = 2.5;
    EXPECT_THROW(loadContent("a.gltf", all.dump()), Error);
}

TEST(GltfForms, NoAttributeMayHaveUnsignedWords)
{
    for (const char* name : {"POSITION", "NORMAL"}) {
        GlbBuilder builder = triangleGlb();
        const int accessor = builder.words({0, 0, 0, 1, 0, 0, 0, 0, 1}, "VEC3");
        builder.document["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
        const std::string message = gltfMessage(builder, ErrorKind::input);
        EXPECT_THAT(message, HasSubstr(fmt::format("accessor {}", accessor)));
        EXPECT_THAT(message, HasSubstr("5125"));
    }
}

TEST(GltfForms, IndicesMayBeSparseOverZeros)
{
    GlbBuilder builder = triangleGlb();
    const std::uint16_t where[] = {1, 2};
    const std::uint16_t what[] = {1, 2};
    const int places = builder.view(where, sizeof where);
    const int values = builder.view(what, sizeof what);
    json& accessors = builder.document["accessors"];
    accessors.push_back({{"componentType", 5123},
                         {"type", "SCALAR"},
                         {"count", 3},
                         {"sparse",
                          {{"count", 2},
                           {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                           {"values", {{"bufferView", values}}}}}});
    builder.document["meshes"][0]["primitives"][0]["indices"] = accessors.size() - 1;
    EXPECT_NEAR(meshes::totalArea(loadContent("a.glb", builder.glb())), 0.5, 1e-6);
}

TEST(GltfForms, APrimitiveWithoutPositionIsLeftOut)
{
    GlbBuilder builder = triangleGlb();
    json bare = builder.document["meshes"][0]["primitives"][0];
    bare["attributes"].erase("POSITION");
    builder.primitive(bare);
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("no POSITION")));
}

TEST(GltfForms, ABufferWithoutBytesIsWrongOnlyWhereItIsUsed)
{
    GlbBuilder builder = triangleGlb();
    json all = json::parse(builder.gltf());
    all["buffers"].push_back({{"byteLength", 64}});
    all["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 36}});
    EXPECT_EQ(loadContent("a.gltf", all.dump()).triangles.size(), 1U);
    all["accessors"][0]["bufferView"] = all["bufferViews"].size() - 1;
    EXPECT_THROW(loadContent("a.gltf", all.dump()), Error);
}

TEST(GltfForms, AProjectionIsNoPlace)
{
    for (std::size_t element : {3U, 7U, 11U, 15U}) {
        GlbBuilder builder = triangleGlb();
        json matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        matrix[element] = 0.5;
        builder.document["nodes"][0]["matrix"] = matrix;
        EXPECT_THAT(gltfMessage(builder, ErrorKind::input), HasSubstr("0 0 0 1"));
    }
}

TEST(GltfForms, CustomAttributesAloneMakeInstances)
{
    GlbBuilder builder = triangleGlb();
    const int ids = builder.shorts({1, 2}, "SCALAR");
    builder.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["_ID"] =
        ids;
    EXPECT_EQ(loadContent("a.glb", builder.glb()).triangles.size(), 2U);
}

TEST(GltfForms, VersionOneIsUnsupportedInEveryForm)
{
    for (const char* text :
         {R"({"asset": {"version": "1.0"}, "buffers": {}, "meshes": {}})",
          R"({"meshes": {"m": {}}, "nodes": {}})", R"({"asset": {"version": 1.0}})"})
        try {
            loadContent("a.gltf", text);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::unsupported) << error.what();
        }
}

TEST(GltfForms, NothingIsFetched)
{
    json all = json::parse(triangleGlb().gltf());
    all["buffers"][0]["uri"] = "HTTPS://example.org/a.bin";
    try {
        loadContent("a.gltf", all.dump());
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_THAT(error.what(), HasSubstr("nothing is fetched"));
    }
}

TEST(GltfForms, WarnsOfNodesTooSmallForTheirDistance)
{
    for (const double far : {0.0, 1e2, 1e4, 1e6, 1e7}) {
        GlbBuilder builder = triangleGlb();
        builder.node({{"mesh", 0}, {"name", "away"}, {"translation", {far, 0.0, 0.0}}});
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
        const double error = std::fabs(meshes::totalArea(mesh) - 1.0);
        if (error > 0.02) {
            EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("lose their shape"))) << far;
        }
        if (far <= 1e4) {
            EXPECT_THAT(diagnostics.warnings(), IsEmpty()) << far;
        }
    }
}

TEST(GltfForms, AnyExponentIsGroundWithinReachOrAnErrorThatNamesNodeAndBound)
{
    std::mt19937 random(3);
    std::uniform_int_distribution<int> exponent(-300, 300);
    std::uniform_int_distribution<int> element(0, 15);
    std::size_t refused = 0;
    for (int i = 0; i < 400; ++i) {
        GlbBuilder builder = triangleGlb();
        json& node = builder.document["nodes"][0];
        const double number = (i % 3 == 0 ? -2.5 : 2.5) * std::pow(10.0, exponent(random));
        if (i % 2 == 0) {
            node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
            int at = element(random);
            at -= at % 4 == 3 ? 1 : 0;
            node["matrix"][std::size_t(at)] = number;
        } else {
            const char* const key = i % 4 == 1 ? "translation" : "scale";
            node[key] = {1.0, 1.0, 1.0};
            node[key][std::size_t(element(random) % 3)] = number;
        }
        try {
            const GroundMesh mesh = loadContent("a.glb", builder.glb());
            for (std::size_t v = 0; v < mesh.positions.size(); ++v)
                EXPECT_TRUE(isWithinReach(worldPosition(mesh, v)));
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
            if (std::fabs(number) > 1.0) {
                EXPECT_THAT(error.what(), HasSubstr("node \""));
                EXPECT_THAT(error.what(), HasSubstr("30000000"));
            }
            ++refused;
        }
    }
    EXPECT_GT(refused, 100U);
}

} // namespace
} // namespace sward::terrain
