#include "core/random.h"
#include "terrain/image/channel_image.h"
#include "terrain/unit_colors.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <functional>

namespace sward::terrain {
namespace {

using testing::HasSubstr;

// A mesh of `primitives` triangles side by side, one to a primitive.
struct MaskGlb {
    GlbBuilder builder;

    explicit MaskGlb(std::size_t primitives)
    {
        for (std::size_t i = 0; i < primitives; ++i) {
            const auto x = static_cast<float>(2 * i);
            const int positions = builder.floats({x, 0, 0, x + 1, 0, 0, x, 0, -1}, "VEC3");
            const nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}}};
            if (i == 0)
                builder.mesh(primitive);
            else
                builder.primitive(primitive);
        }
        builder.node({{"mesh", 0}, {"name", "terrain"}});
    }

    nlohmann::json& attributes(std::size_t primitive)
    {
        return builder.document["meshes"][0]["primitives"][primitive]["attributes"];
    }
};

float random(std::uint32_t trial, std::uint32_t number)
{
    return static_cast<float>(uniform(41, trial, number));
}

std::vector<float> randoms(std::uint32_t trial, std::uint32_t first, std::size_t count)
{
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(random(trial, first + static_cast<std::uint32_t>(i)));
    return values;
}

ImportSettings reading(const std::vector<std::string>& attributes)
{
    ImportSettings settings;
    settings.masks.attributes = attributes;
    return settings;
}

// What a mask reads of set `name`: the attribute, or what the ground keeps anyway.
glm::vec2 uvOf(const GroundMesh& mesh, const std::string& name, std::size_t vertex)
{
    const VertexAttribute* const own = mesh.attributes.find(name);
    return own != nullptr ? glm::vec2(own->values[vertex]) : mesh.uvs[vertex];
}

TEST(MaskInputs, AreSetsAsStoredWhateverTheMaterialDoes)
{
    // Any transform and any set of the material leave each set as the file stores it.
    for (std::uint32_t trial = 0; trial < 40; ++trial) {
        MaskGlb file(2);
        const std::vector<std::vector<float>> sets = {randoms(trial, 0, 6), randoms(trial, 6, 6),
                                                      randoms(trial, 12, 6), randoms(trial, 18, 6)};
        for (std::size_t i = 0; i < 4; ++i)
            file.attributes(i / 2)[i % 2 == 0 ? "TEXCOORD_0" : "TEXCOORD_1"] =
                file.builder.floats(sets[i], "VEC2");
        nlohmann::json texture = {{"index", 0}, {"texCoord", trial % 2}};
        if (trial % 4 > 1)
            texture["extensions"]["KHR_texture_transform"] = {
                {"scale", {1.0f + 8.0f * random(trial, 30), 2.0f}},
                {"offset", {random(trial, 31), 0.5f}},
                {"rotation", random(trial, 32)}};
        const std::string png = "no image";
        file.builder.document["images"] = {
            {{"bufferView", file.builder.view(png.data(), png.size())}, {"mimeType", "image/png"}}};
        file.builder.document["textures"] = {{{"source", 0}}};
        file.builder.document["materials"] = {
            {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}}};
        file.builder.document["meshes"][0]["primitives"][0]["material"] = 0;
        const GroundMesh mesh =
            loadContent("a.glb", file.builder.glb(), reading({"TEXCOORD_0", "TEXCOORD_1"}));
        EXPECT_TRUE(mesh.attributes.gaps.empty());
        // Normals are made, and vertices keep their order.
        ASSERT_EQ(mesh.positions.size(), 6U);
        for (std::size_t v = 0; v < 6; ++v)
            for (std::size_t set = 0; set < 2; ++set) {
                const std::vector<float>& own = sets[2 * (v / 3) + set];
                EXPECT_EQ(uvOf(mesh, set == 0 ? "TEXCOORD_0" : "TEXCOORD_1", v),
                          glm::vec2(own[2 * (v % 3)], own[2 * (v % 3) + 1]))
                    << trial << " " << v;
            }
    }
}

TEST(MaskInputs, AreKnownToBeMissingForEveryPrimitive)
{
    const std::vector<std::string> names = {"COLOR_0", "COLOR_1", "TEXCOORD_0", "TEXCOORD_1",
                                            "_MASK"};
    constexpr std::size_t primitives = 4;
    for (std::uint32_t given = 0; given < 1U << primitives; ++given)
        for (const std::string& name : names) {
            MaskGlb file(primitives);
            for (std::size_t i = 0; i < primitives; ++i)
                if ((given >> i & 1U) != 0)
                    file.attributes(i)[name] = file.builder.floats(randoms(given, 0,
                                                                           name[0] == 'C'   ? 9
                                                                           : name[0] == 'T' ? 6
                                                                                            : 3),
                                                                   name[0] == 'C'   ? "VEC3"
                                                                   : name[0] == 'T' ? "VEC2"
                                                                                    : "SCALAR");
            const GroundMesh mesh = loadContent("a.glb", file.builder.glb(), reading({name}));
            std::uint32_t missing = 0;
            for (const AttributeGap& gap : mesh.attributes.gaps) {
                EXPECT_EQ(gap.attribute, name);
                ASSERT_EQ(gap.end, gap.first + 1);
                EXPECT_THAT(mesh.attributes.parts[gap.part],
                            HasSubstr(fmt::format("primitive {}", gap.first)));
                missing |= 1U << gap.first;
            }
            EXPECT_EQ(missing, (1U << primitives) - 1U - given) << name;
        }
}

TEST(MaskInputs, AreTheSameNumbersInEveryType)
{
    const std::vector<std::uint8_t> bytes = {0, 51, 255};
    for (const char* const name : {"_MASK", "COLOR_1"}) {
        const bool isColor = name[0] == 'C';
        const auto valuesOf = [&](const std::function<int(GlbBuilder&, const char*)>& add) {
            MaskGlb file(1);
            file.attributes(0)[name] = add(file.builder, isColor ? "VEC3" : "SCALAR");
            const GroundMesh mesh = loadContent("a.glb", file.builder.glb(), reading({name}));
            EXPECT_EQ(mesh.attributes.list.size(), 1U);
            const VertexAttribute& own = mesh.attributes.list.at(0);
            EXPECT_EQ(own.components, isColor ? 4U : 1U);
            for (std::size_t v = 0; v < 3; ++v)
                EXPECT_NEAR(own.values[v].x, static_cast<float>(bytes[v]) / 255.0f, 1e-6f) << name;
        };
        const auto repeated = [&](auto unit) {
            std::vector<decltype(unit)> values;
            for (const std::uint8_t byte : bytes)
                for (int c = 0; c < (isColor ? 3 : 1); ++c)
                    values.push_back(static_cast<decltype(unit)>(byte * unit));
            return values;
        };
        valuesOf([&](GlbBuilder& b, const char* type) {
            return b.bytes(repeated(std::uint8_t(1)), type, true);
        });
        valuesOf([&](GlbBuilder& b, const char* type) {
            return b.bytes(repeated(std::uint8_t(1)), type, false);
        });
        valuesOf([&](GlbBuilder& b, const char* type) {
            return b.shorts(repeated(std::uint16_t(257)), type, true);
        });
        valuesOf([&](GlbBuilder& b, const char* type) {
            return b.shorts(repeated(std::uint16_t(257)), type, false);
        });
        valuesOf([&](GlbBuilder& b, const char* type) {
            return b.floats(repeated(1.0f / 255.0f), type);
        });
        valuesOf([&](GlbBuilder& b, const char* type) { return b.floats(repeated(1.0f), type); });
    }
}

TEST(MaskInputs, AreKeptWhereGroundsAreJoined)
{
    MaskGlb file(1);
    file.attributes(0)["_MASK"] = file.builder.floats({0.25f, 0.5f, 0.75f}, "SCALAR");
    const GroundMesh painted = loadContent("a.glb", file.builder.glb(), reading({"_MASK"}));
    const GroundMesh bare = loadContent("b.glb", MaskGlb(2).builder.glb(), reading({"_MASK"}));
    for (const bool paintedFirst : {false, true}) {
        GroundMesh joined = paintedFirst ? painted : bare;
        append(joined, paintedFirst ? bare : painted);
        validate(joined, "joined");
        const std::size_t first = paintedFirst ? 0 : bare.positions.size();
        EXPECT_EQ(joined.attributes.list.at(0).values[first + 2].x, 0.75f);
        EXPECT_EQ(joined.attributes.gaps.size(), 2U);
        EXPECT_EQ(joined.attributes.gaps[0].first, paintedFirst ? 1U : 0U);
    }
}

TEST(MaskInputs, OfTextFormatsAreMissingPerObject)
{
    const std::string obj = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 0 -1 1 0 0\n"
                            "v 5 0 0\nv 6 0 0\nv 5 0 -1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                            "o painted\nf 1 2 3\no mapped\nf 4/1 5/2 6/3\n";
    const GroundMesh mesh =
        loadContent("a.obj", obj, reading({"COLOR_0", "TEXCOORD_0", "COLOR_1"}));
    ASSERT_EQ(mesh.attributes.gaps.size(), 4U);
    EXPECT_EQ(mesh.attributes.gaps[0].attribute, "COLOR_0");
    EXPECT_EQ(mesh.attributes.gaps[0].first, 1U);
    EXPECT_THAT(mesh.attributes.parts[mesh.attributes.gaps[0].part], HasSubstr("\"mapped\""));
    EXPECT_EQ(mesh.attributes.gaps[1].attribute, "TEXCOORD_0");
    EXPECT_EQ(mesh.attributes.gaps[1].first, 0U);
    EXPECT_EQ(mesh.attributes.gaps[3].attribute, "COLOR_1");

    // Generated ground has texture coordinates alone.
    Diagnostics diagnostics;
    const GroundMesh plane = load("plane", reading({"TEXCOORD_0", "COLOR_0"}), diagnostics);
    ASSERT_EQ(plane.attributes.gaps.size(), 1U);
    EXPECT_EQ(plane.attributes.gaps[0].end, plane.triangles.size());
}

TEST(MaskInputs, AreImagesAsTheFileStoresThem)
{
    // A checker of single pixels, too large to be kept for display.
    constexpr int side = 2560;
    std::vector<std::uint8_t> rgba(std::size_t(4) * side * side, 255);
    for (std::size_t i = 0; i < std::size_t(side) * side; ++i)
        if ((i % side + i / side) % 2 == 1)
            rgba[4 * i] = 0;
    std::string png;
    stbi_write_png_to_func(
        [](void* to, void* bytes, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                                  static_cast<std::size_t>(size));
        },
        &png, side, side, 4, rgba.data(), 4 * side);
    MaskGlb file(1);
    file.builder.document["images"] = {
        {{"bufferView", file.builder.view(png.data(), png.size())}, {"mimeType", "image/png"}}};
    file.builder.document["textures"] = {{{"source", 0}}};
    file.builder.document["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    ImportSettings settings;
    settings.masks.imageChannels = 1;
    const GroundMesh mesh = loadContent("a.glb", file.builder.glb(), settings);
    ASSERT_EQ(mesh.images.size(), 1U);
    EXPECT_LT(mesh.images[0].width, 2560U);
    ASSERT_NE(mesh.images[0].stored[0], nullptr);
    EXPECT_EQ(mesh.images[0].stored[1], nullptr);
    const ScratchFolder folder;
    const ChannelImage separate = readChannel(folder.write("mask.png", png), 0);
    EXPECT_EQ(mesh.images[0].stored[0]->values, separate.values);
}

TEST(BringToUnit, DividesWhatIsNoShare)
{
    const auto brought = [](std::vector<glm::vec4> colors, std::size_t warnings) {
        Diagnostics diagnostics;
        bringToUnit(colors, "a.obj", "its colour", diagnostics);
        EXPECT_EQ(diagnostics.warnings().size(), warnings);
        return colors;
    };
    EXPECT_EQ(brought({{0.5f, 1.0f, 0.0f, 1.0f}}, 0)[0], glm::vec4(0.5f, 1.0f, 0.0f, 1.0f));
    EXPECT_EQ(brought({{1.0001f, 0.0f, 0.0f, 1.0f}}, 0)[0].x, 1.0f);
    EXPECT_EQ(brought({{1.5f, -0.5f, 0.0f, 1.0f}}, 1)[0], glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    EXPECT_EQ(brought({{51.0f, 255.0f, 0.0f, 1.0f}}, 1)[0], glm::vec4(0.2f, 1.0f, 0.0f, 1.0f));
    EXPECT_EQ(brought({{51.0f, 0.0f, 0.0f, 255.0f}}, 1)[0], glm::vec4(0.2f, 0.0f, 0.0f, 1.0f));
    EXPECT_EQ(brought({{13107.0f, 0.0f, 0.0f, 1.0f}}, 1)[0].x, 0.2f);
}

} // namespace
} // namespace sward::terrain
