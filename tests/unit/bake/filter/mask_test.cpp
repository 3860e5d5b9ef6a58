#include "bake/mask/mask.h"
#include "core/error.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

namespace sward::bake {
namespace {

// A level square around the origin whose image coordinates run from 0 to `turns`.
terrain::GroundMesh mapped(double side, double turns = 1.0)
{
    terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(side), glm::uvec2(8U)},
                                                    [](double, double) { return 0.0; });
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.uvs[v] = glm::vec2(glm::dvec2(mesh.positions[v].x, mesh.positions[v].z) / side + 0.5) *
                      float(turns);
    return mesh;
}

std::shared_ptr<const terrain::ChannelImage> image(std::uint32_t width,
                                                   const std::vector<double>& values)
{
    auto made = std::make_shared<terrain::ChannelImage>();
    made->width = width;
    made->height = static_cast<std::uint32_t>(values.size()) / width;
    for (const double value : values)
        made->values.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * value)));
    return made;
}

Mask texture(std::shared_ptr<const terrain::ChannelImage> pixels, bool invert = false)
{
    return {.source = Mask::Source::texture, .invert = invert, .file = "mask.png", .image = pixels};
}

TEST(TextureMask, MultipliesDensityByWhatIsPainted)
{
    // Four fields side by side, bare to full; v grows from the top row down.
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {texture(image(2, {0.0, 1.0, 0.25, 0.5}))};
    const terrain::GroundMesh mesh = mapped(10.0, 1.0);
    const tests::Trial trial = tests::tryRoots(mesh, settings, 400.0);
    // Within half a pixel of its border a field mixes with its neighbours; the centres are pure.
    std::array<double, 4> counts{};
    for (const RootSample& root : trial.kept) {
        const double x = double(root.position.x) / 5.0;
        const double z = double(root.position.z) / 5.0;
        if (std::fabs(std::fabs(x) - 0.5) < 0.1 && std::fabs(std::fabs(z) - 0.5) < 0.1)
            counts[(x > 0.0 ? 1U : 0U) + (z > 0.0 ? 2U : 0U)] += 1.0;
    }
    const double full = 400.0 * 1.0;
    EXPECT_LT(counts[0], 0.15 * full);
    EXPECT_GT(counts[1], 0.85 * full);
    EXPECT_NEAR(counts[2], 0.27 * full, 0.1 * full);
    EXPECT_NEAR(counts[3], 0.5 * full, 0.1 * full);
    EXPECT_EQ(trial.count(Reject::mask), trial.tried - trial.kept.size());
}

TEST(TextureMask, IsBilinearBetweenPixels)
{
    const auto pixels = image(4, {0.0, 1.0, 1.0, 0.0});
    EXPECT_NEAR(terrain::valueAt(*pixels, {0.125, 0.5}), 0.0, 1e-4);
    EXPECT_NEAR(terrain::valueAt(*pixels, {0.25, 0.5}), 0.5, 1e-4);
    EXPECT_NEAR(terrain::valueAt(*pixels, {0.3, 0.5}), 0.7, 1e-4);
    EXPECT_NEAR(terrain::valueAt(*pixels, {0.5, 0.1}), 1.0, 1e-4);
    // It repeats in both directions, to the other side of zero as well.
    for (const double turn : {-3.0, -1.0, 2.0})
        EXPECT_NEAR(terrain::valueAt(*pixels, {0.3 + turn, 7.0 * turn}), 0.7, 1e-4);
    EXPECT_NEAR(terrain::valueAt(*pixels, {0.0, 0.0}), 0.0, 1e-4);
}

TEST(TextureMask, RepeatsAndIsInverted)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {texture(image(2, {0.25, 0.25, 0.25, 0.25}), true)};
    EXPECT_NEAR(tests::tryRoots(mapped(10.0, 7.5), settings, 100.0).share(), 0.75, 0.01);
}

TEST(Masks, AreMultiplied)
{
    terrain::GroundMesh mesh = mapped(10.0);
    mesh.hasColors = true;
    for (glm::vec4& color : mesh.colors)
        color = glm::vec4(0.5f, 0.8f, 1.0f, 1.0f);
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {texture(image(1, {0.5})), {.channel = 0}, {.channel = 1}};
    EXPECT_NEAR(tests::tryRoots(mesh, settings, 200.0).share(), 0.2, 0.01);
}

TEST(MaterialTextureMask, IsTheMaterialsOwnImageAsStored)
{
    terrain::GroundMesh mesh = mapped(10.0);
    mesh.images.push_back({"paint", 1, 1, {51, 102, 204, 255}});
    mesh.materials[0].image = 0;
    BakeSettings settings = tests::plainSettings(1.0);
    // 102/255 is 0.4 as a number, and would be 0.13 as a colour.
    for (const auto& [channel, share] : {std::pair(0, 0.2), std::pair(1, 0.4), std::pair(2, 0.8)}) {
        settings.masks = {{.source = Mask::Source::materialTexture, .channel = channel}};
        EXPECT_NEAR(tests::tryRoots(mesh, settings, 100.0).share(), share, 0.015);
    }
}

TEST(CheckMasks, NamesTheMaterialThatLacksSomething)
{
    terrain::GroundMesh mesh = meshes::square(2.0);
    mesh.materials[0].name = "mossy rock";
    const auto complaint = [&](const Mask& mask) {
        try {
            checkMasks({mask}, mesh);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return std::string(error.what());
        }
        return std::string();
    };
    const Mask painted = texture(image(1, {1.0}));
    const Mask own{.source = Mask::Source::materialTexture};
    EXPECT_NE(complaint(Mask()).find("no vertex colours"), std::string::npos);
    EXPECT_NE(complaint(painted).find("\"mossy rock\" has no texture coordinates"),
              std::string::npos);
    EXPECT_NE(complaint(own).find("\"mossy rock\" has no base colour image"), std::string::npos);
    mesh.uvs[1] = glm::vec2(0.5f, 1.0f);
    mesh.hasColors = true;
    EXPECT_EQ(complaint(Mask()), "");
    EXPECT_EQ(complaint(painted), "");
    // Ground that bears no grass needs no mask data.
    std::fill(mesh.bears.begin(), mesh.bears.end(), std::uint8_t(0));
    EXPECT_EQ(complaint(own), "");
}

TEST(Masks, AreReadAndWrittenInEveryForm)
{
    const std::array<std::array<const char*, 3>, 14> forms{{
        {"vertex-color:G", "vertex-color:G", "COLOR_0"},
        {"vertex-color1:R", "vertex-color1:R", "COLOR_1"},
        {"vertex-color15:A:invert", "vertex-color15:A:invert", "COLOR_15"},
        {"vertex-color:_MASK", "vertex-color:_MASK:R", "_MASK"},
        {"vertex-color:_WET_2:B:invert", "vertex-color:_WET_2:B:invert", "_WET_2"},
        {"vertex-color:R:or-white", "vertex-color:R:or-white", "COLOR_0"},
        {"vertex-color:_A:or-white:invert", "vertex-color:_A:R:or-white:invert", "_A"},
        {"texture:a.png", "texture:a.png:R", "TEXCOORD_0"},
        {"texture:a.png:uv1", "texture:a.png:R:uv1", "TEXCOORD_1"},
        {"texture:a.png:B:uv12:invert", "texture:a.png:B:uv12:invert", "TEXCOORD_12"},
        {"texture:a.png:transform", "texture:a.png:R:transform", terrain::materialCoordinates},
        {"texture:C:uvs/a.png:G", "texture:C:uvs/a.png:G", "TEXCOORD_0"},
        {"material-texture:A", "material-texture:A", terrain::materialCoordinates},
        {"ground:green", "ground:green", ""},
    }};
    for (const auto& [text, written, attribute] : forms) {
        const std::optional<Mask> mask = readMask(text);
        ASSERT_TRUE(mask) << text;
        EXPECT_EQ(textOf(*mask), written);
        EXPECT_EQ(mask->attributeName(), attribute) << text;
        EXPECT_EQ(textOf(*readMask(written)), written);
    }
    for (const char* const text :
         {"vertex-color16:R", "vertex-color01:R", "vertex-color-1:R", "vertex-color1",
          "vertex-color:mask", "material-texture:R:uv1", "texture:", "texture::uv1"})
        EXPECT_FALSE(readMask(text)) << text;
}

TEST(CheckMasks, NamesThePartWithoutTheAttribute)
{
    terrain::GroundMesh mesh = meshes::grid(4, 2.0);
    mesh.hasColors = true;
    mesh.materials[0].name = "turf";
    mesh.attributes.addGap("COLOR_0", 8, 12, "a.glb: mesh 0, primitive 2");
    mesh.attributes.addGap("_WET", 0, 32, "a.glb: mesh 0");
    const auto complaint = [&](const char* text) {
        try {
            checkMasks({parseMask(text)}, mesh);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string text = complaint("vertex-color:R");
    EXPECT_NE(text.find("a.glb: mesh 0, primitive 2: material \"turf\" has no vertex colours"),
              std::string::npos)
        << text;
    EXPECT_NE(complaint("vertex-color:_WET").find("no vertex attribute _WET"), std::string::npos);
    EXPECT_EQ(complaint("vertex-color:R:or-white"), "");
    // What bears nothing needs nothing.
    std::fill_n(mesh.bears.begin() + 8, 4, std::uint8_t(0));
    EXPECT_EQ(complaint("vertex-color:R"), "");
    // A channel that the attribute does not have is an error too.
    mesh.attributes = {};
    mesh.attributes.list.push_back({"_WET", 1, {}});
    mesh.attributes.resize(mesh.positions.size());
    EXPECT_EQ(complaint("vertex-color:_WET:R"), "");
    EXPECT_NE(complaint("vertex-color:_WET:G").find("1 components"), std::string::npos);
}

TEST(LoadImages, SaysWhichFileIsMissing)
{
    std::vector<Mask> masks = {parseMask("texture:no such mask.png:R")};
    try {
        loadImages(masks);
        FAIL() << "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_NE(std::string(error.what()).find("no such mask.png"), std::string::npos);
    }
}

} // namespace
} // namespace sward::bake
