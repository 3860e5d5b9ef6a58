#include "core/error.h"
#include "core/random.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::HasSubstr;
using testing::Not;

// Every kind of glTF reference in one small file.
GlbBuilder richGlb()
{
    GlbBuilder builder = triangleGlb();
    builder.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        builder.bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", true);
    builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    const char notAnImage[] = "no image at all";
    const int image = builder.view(notAnImage, sizeof notAnImage);
    builder.document["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    builder.document["textures"] = {{{"source", 0}}};
    builder.document["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const std::vector<std::uint16_t> index = {1};
    const std::vector<float> value = {2, 0, 0};
    const int indexView = builder.view(index.data(), 2);
    const int valueView = builder.view(value.data(), 12);
    builder.document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
        {"values", {{"bufferView", valueView}}}};
    const int shifts = builder.floats({1, 0, 0, 2, 0, 0}, "VEC3");
    builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                    ["TRANSLATION"] = shifts;
    builder.node({{"children", {0}}, {"rotation", {0, 0, 0, 1}}});
    // A morph, and the same mesh with a skin.
    builder.document["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", builder.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")}}};
    builder.document["meshes"][0]["weights"] = {0.5};
    builder.document["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        builder.bytes({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    builder.document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        builder.bytes({255, 0, 0, 0, 255, 0, 0, 0, 55, 200, 0, 0}, "VEC4", true);
    std::vector<float> binds(32, 0.0f);
    for (std::size_t i = 0; i < 32; i += i % 16 == 15 ? 1 : 5)
        binds[i] = 1.0f;
    builder.document["skins"] = {
        {{"joints", {0, 1}}, {"inverseBindMatrices", builder.floats(binds, "MAT4")}}};
    builder.node({{"mesh", 0}, {"skin", 0}, {"weights", {0.25}}});
    return builder;
}

// A damaged file must load or be refused by an error that names it.
void expectNoCrash(const std::string& name, const std::string& content, const std::string& what)
{
    try {
        loadContent(name, content);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(name)) << what;
    }
}

ErrorKind kindOf(const GlbBuilder& builder, std::string* message = nullptr)
{
    try {
        loadContent("a.glb", builder.glb());
    } catch (const Error& error) {
        if (message != nullptr)
            *message = error.what();
        return error.kind();
    }
    return ErrorKind::difference;
}

TEST(GltfDamage, RefusesEveryTruncation)
{
    const std::string file = richGlb().glb();
    for (std::size_t length = 0; length < file.size(); ++length) {
        try {
            loadContent("a.glb", file.substr(0, length));
            ADD_FAILURE() << length << " of " << file.size() << " bytes were read";
        } catch (const Error& error) {
            EXPECT_TRUE(error.kind() == ErrorKind::input) << length << ": " << error.what();
        }
    }
}

TEST(GltfDamage, SurvivesEveryFlippedByte)
{
    const std::string file = richGlb().glb();
    for (std::size_t at = 0; at < file.size(); ++at)
        for (const unsigned mask : {0x01U, 0x10U, 0x80U}) {
            std::string damaged = file;
            damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ mask);
            expectNoCrash("a.glb", damaged, fmt::format("byte {} xor {}", at, mask));
        }
}

TEST(GltfDamage, SurvivesDigitsThatChange)
{
    // Keeps the JSON valid, so that wrong numbers get past the parser.
    const std::string file = richGlb().glb();
    const std::size_t jsonEnd = file.find("BIN");
    for (std::size_t at = 20; at < jsonEnd; ++at)
        if (file[at] >= '0' && file[at] <= '9')
            for (const char digit : {'0', '7', '9'}) {
                std::string damaged = file;
                damaged[at] = digit;
                expectNoCrash("a.glb", damaged, fmt::format("digit {} is {}", at, digit));
            }
}

// Replaces each number and each container of the document, one after the other.
void sweep(const nlohmann::json& document, const std::vector<nlohmann::json>& replacements)
{
    const nlohmann::json flat = document.flatten();
    for (const auto& [pointer, value] : flat.items())
        for (const nlohmann::json& replacement : replacements) {
            nlohmann::json damaged = document;
            damaged[nlohmann::json::json_pointer(pointer)] = replacement;
            expectNoCrash("a.gltf", damaged.dump(), pointer + " = " + replacement.dump());
        }
}

TEST(GltfDamage, SurvivesAnyReferenceThatLeadsAstray)
{
    const nlohmann::json document = nlohmann::json::parse(richGlb().gltf());
    sweep(document, {-1, 1, 3, 7, 100, 65536, 2147483647, 2147483648U, 4294967295U,
                     9223372036854775807LL, 18446744073709551615ULL, 1e300, 0.5});
}

TEST(GltfDamage, SurvivesAnyValueOfAnotherType)
{
    const nlohmann::json document = nlohmann::json::parse(richGlb().gltf());
    sweep(document, {nullptr, true, "text", nlohmann::json::array(), nlohmann::json::object(),
                     nlohmann::json::array({0, 0, 0})});
}

TEST(GltfDamage, SurvivesPartsThatAreMissing)
{
    const nlohmann::json document = nlohmann::json::parse(richGlb().gltf());
    const nlohmann::json flat = document.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        nlohmann::json damaged = document;
        const nlohmann::json::json_pointer leaf(pointer);
        nlohmann::json& parent = damaged[leaf.parent_pointer()];
        if (parent.is_object())
            parent.erase(leaf.back());
        expectNoCrash("a.gltf", damaged.dump(), pointer + " erased");
    }
}

TEST(GltfDamage, RefusesAnExtensionThatIsRequiredAndUnknown)
{
    for (const char* name : {"EXT_structural_metadata", "ACME_ground"}) {
        GlbBuilder builder = triangleGlb();
        builder.document["extensionsUsed"] = {name};
        builder.document["extensionsRequired"] = {name};
        std::string message;
        EXPECT_EQ(kindOf(builder, &message), ErrorKind::unsupported);
        EXPECT_THAT(message, HasSubstr(name));
        EXPECT_THAT(message, HasSubstr("a.glb"));
    }
}

TEST(GltfDamage, ReadsAFileThatOnlyUsesAnUnknownExtension)
{
    GlbBuilder builder = triangleGlb();
    builder.document["extensionsUsed"] = {"ACME_ground"};
    EXPECT_EQ(loadContent("a.glb", builder.glb()).triangles.size(), 1U);
}

TEST(GltfDamage, RefusesOtherVersions)
{
    GlbBuilder old = triangleGlb();
    old.document["asset"]["version"] = "1.0";
    EXPECT_EQ(kindOf(old), ErrorKind::unsupported);
    std::string container = triangleGlb().glb();
    container[4] = 1;
    EXPECT_THROW(loadContent("a.glb", container), Error);
}

TEST(GltfDamage, RefusesRingsOfNodesAndTwoParents)
{
    GlbBuilder ring = triangleGlb();
    ring.document["nodes"][0]["children"] = {1};
    ring.node({{"children", {0}}});
    ring.document["scenes"] = {{{"nodes", {0}}}};
    EXPECT_EQ(kindOf(ring), ErrorKind::input);

    GlbBuilder shared = triangleGlb();
    shared.node({{"children", {0}}});
    shared.node({{"children", {0}}});
    EXPECT_EQ(kindOf(shared), ErrorKind::input);

    GlbBuilder deep = triangleGlb();
    for (int i = 0; i < 1000; ++i)
        deep.node({{"children", {i}}});
    EXPECT_EQ(kindOf(deep), ErrorKind::input);
}

// Files of a few kilobytes that request gigabytes, or hours.
TEST(GltfDamage, RefusesToBecomeMuchLargerThanItsFile)
{
    std::string message;
    GlbBuilder twice = triangleGlb();
    twice.document["scenes"] = {{{"nodes", {0, 0}}}};
    EXPECT_EQ(kindOf(twice, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("twice"));

    // Accessors without bytes are zeros: instances, vertices.
    GlbBuilder instances = triangleGlb();
    instances.document["accessors"].push_back(
        {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1 << 24}});
    instances.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                      ["TRANSLATION"] = 3;
    EXPECT_EQ(kindOf(instances, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("no bufferView"));
    instances.document["accessors"][3]["count"] = 1 << 14;
    instances.document["meshes"][0]["primitives"] = nlohmann::json::array();
    for (int i = 0; i < 1000; ++i)
        instances.primitive({{"attributes", {{"POSITION", 0}}}, {"indices", 2}});
    EXPECT_EQ(kindOf(instances, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("too many for"));

    GlbBuilder nodes = triangleGlb();
    nodes.document["nodes"] = nlohmann::json(600'000, nlohmann::json::object());
    nodes.document["scenes"] = nlohmann::json::array();
    EXPECT_EQ(kindOf(nodes, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("600000 nodes"));

    GlbBuilder path = triangleGlb();
    for (int i = 0; i < 50; ++i)
        path.node({{"children", {i}}, {"name", std::string(100, 'x')}});
    EXPECT_EQ(kindOf(path, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("4096"));
}

TEST(GltfDamage, RefusesJsonThatIsDeepOrEndless)
{
    const auto messageOf = [](const std::string& content) -> std::string {
        try {
            loadContent("a.gltf", content);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "it was read";
    };
    EXPECT_THAT(messageOf(std::string(1 << 24, '[')), HasSubstr("128 deep"));
    std::string many = "{\"extras\": [0";
    for (int i = 0; i < 8'000'000; ++i)
        many += ",0";
    EXPECT_THAT(messageOf(many + "]}"), HasSubstr("8000000"));
}

TEST(GltfDamage, SaysThatThereAreNoTriangles)
{
    GlbBuilder empty;
    empty.node({{"name", "nothing"}});
    std::string message;
    EXPECT_EQ(kindOf(empty, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("no triangles"));

    GlbBuilder flat = triangleGlb();
    flat.document["nodes"][0]["scale"] = {0, 1, 1};
    EXPECT_EQ(kindOf(flat, &message), ErrorKind::input);
}

} // namespace
} // namespace sward::terrain
