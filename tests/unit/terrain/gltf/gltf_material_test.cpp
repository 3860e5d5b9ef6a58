#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string png(int width, int height, const std::vector<std::uint8_t>& rgba)
{
    std::string file;
    stbi_write_png_to_func(
        [](void* to, void* bytes, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                                  static_cast<std::size_t>(size));
        },
        &file, width, height, 4, rgba.data(), 4 * width);
    return file;
}

// A triangle in a material whose image lies in the BIN chunk.
GlbBuilder texturedGlb(const std::string& image)
{
    GlbBuilder builder = triangleGlb();
    const int view = builder.view(image.data(), image.size());
    builder.document["images"] = {
        {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "moss"}}};
    builder.document["textures"] = {{{"source", 0}}};
    builder.document["materials"] = {{{"name", "grass"},
                                      {"doubleSided", true},
                                      {"pbrMetallicRoughness",
                                       {{"baseColorFactor", {0.5, 0.25, 0.125, 1.0}},
                                        {"metallicFactor", 0.0},
                                        {"roughnessFactor", 0.75},
                                        {"baseColorTexture", {{"index", 0}}}}}}};
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

TEST(GltfMaterial, ReadsColorRoughnessSidesAndImage)
{
    const GroundMesh mesh =
        loadContent("a.glb", texturedGlb(png(2, 1, {255, 0, 0, 255, 0, 128, 0, 255})).glb());
    ASSERT_EQ(mesh.materials.size(), 1U);
    const GroundMaterial& material = mesh.materials[0];
    EXPECT_EQ(material.name, "grass");
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
    EXPECT_EQ(material.roughness, 0.75f);
    EXPECT_EQ(material.metallic, 0.0f);
    ASSERT_EQ(material.image, 0U);
    EXPECT_EQ(mesh.images[0].name, "moss");
    EXPECT_EQ(mesh.images[0].width, 2U);
    EXPECT_THAT(mesh.images[0].rgba, ElementsAre(255, 0, 0, 255, 0, 128, 0, 255));
}

TEST(GltfMaterial, KeepsTheMaterialWhenItsImageCannotBeRead)
{
    Diagnostics diagnostics;
    const GroundMesh mesh =
        loadContent("a.glb", texturedGlb("RIFFxxxxWEBPVP8 ").glb(), {}, &diagnostics);
    EXPECT_EQ(mesh.materials[0].name, "grass");
    EXPECT_EQ(mesh.materials[0].image, GroundMaterial::noImage);
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("moss")));
}

TEST(GltfMaterial, KeepsTheMaterialWhenItsImageIsMissing)
{
    nlohmann::json document = nlohmann::json::parse(texturedGlb(png(1, 1, {1, 2, 3, 4})).gltf());
    document["images"][0] = {{"uri", "not%20here.png"}};
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.gltf", document.dump(), {}, &diagnostics);
    EXPECT_EQ(mesh.materials[0].image, GroundMaterial::noImage);
    EXPECT_EQ(diagnostics.warnings().size(), 1U);
}

TEST(GltfMaterial, ShrinksHugeImagesByBoxes)
{
    // Left half black, right half white, 4096 wide: every box of 2 x 2 is of one colour.
    std::vector<std::uint8_t> rgba(std::size_t(4) * 4096 * 2, 255);
    for (std::size_t y = 0; y < 2; ++y)
        for (std::size_t x = 0; x < 2048; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                rgba[4 * (y * 4096 + x) + c] = 0;
    const GroundMesh mesh = loadContent("a.glb", texturedGlb(png(4096, 2, rgba)).glb());
    ASSERT_EQ(mesh.images[0].width, 2048U);
    ASSERT_EQ(mesh.images[0].height, 1U);
    EXPECT_EQ(mesh.images[0].rgba[4 * 1023], 0);
    EXPECT_EQ(mesh.images[0].rgba[4 * 1024], 255);
}

TEST(GltfMaterial, NumbersThePrimitivesOfSeveralMaterials)
{
    GlbBuilder builder = triangleGlb();
    builder.document["materials"] = {{{"name", "path"}}, {{"name", "grass"}}};
    builder.document["meshes"][0]["primitives"][0]["material"] = 1;
    builder.primitive({{"attributes", {{"POSITION", 0}}}, {"material", 0}});
    builder.primitive({{"attributes", {{"POSITION", 0}}}});
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    ASSERT_EQ(mesh.materials.size(), 3U);
    EXPECT_THAT(mesh.materialOf, ElementsAre(1U, 0U, 2U));

    const GroundMesh grassOnly = loadContent("a.glb", builder.glb(), {.bearingMaterials = {"gr*"}});
    EXPECT_THAT(grassOnly.bears, ElementsAre(1, 0, 0));
}

TEST(GltfMaterial, AppliesTextureTransforms)
{
    GlbBuilder builder = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    builder.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.uvs[1], glm::vec2(2.5f, 0.25f));
    EXPECT_EQ(mesh.uvs[2], glm::vec2(0.5f, 3.25f));
}

TEST(GltfMaterial, RotatesTextureCoordinatesAsTheExtensionHasIt)
{
    // The example of the specification: the lower left quarter of the image, rotated.
    GlbBuilder builder = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    builder.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                    ["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    const std::vector<glm::vec2> expected = {{0.0f, 1.0f}, {0.0f, 0.5f}, {0.5f, 1.0f}};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(glm::distance(mesh.uvs[i], expected[i]), 1e-6f) << i;
}

TEST(GltfMaterial, TakesTheTextureCoordinatesThatItsTextureNames)
{
    GlbBuilder builder = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    auto& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["attributes"]["TEXCOORD_1"] = builder.floats({0, 0, 3, 0, 0, 3}, "VEC2");
    builder.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    EXPECT_EQ(loadContent("a.glb", builder.glb()).uvs[1], glm::vec2(3.0f, 0.0f));

    primitive["attributes"].erase("TEXCOORD_1");
    Diagnostics diagnostics;
    EXPECT_EQ(loadContent("a.glb", builder.glb(), {}, &diagnostics).uvs[1], glm::vec2(0.0f));
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("TEXCOORD_1")));
}

TEST(GltfMaterial, KnowsHowAnImageGoesOnBeyondItsEdges)
{
    GlbBuilder builder = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    GroundMaterial material = loadContent("a.glb", builder.glb()).materials[0];
    EXPECT_EQ(material.wrapU, ImageWrap::repeat);
    EXPECT_EQ(material.wrapV, ImageWrap::repeat);
    builder.document["samplers"] = {{{"magFilter", 9729}}, {{"wrapS", 33071}, {"wrapT", 33648}}};
    builder.document["textures"][0]["sampler"] = 1;
    material = loadContent("a.glb", builder.glb()).materials[0];
    EXPECT_EQ(material.wrapU, ImageWrap::clamp);
    EXPECT_EQ(material.wrapV, ImageWrap::mirror);
    builder.document["textures"][0]["sampler"] = 2;
    EXPECT_THROW(loadContent("a.glb", builder.glb()), Error);
}

TEST(GltfMaterial, ReadsImagesFromDataUrisAndFiles)
{
    const std::string image = png(1, 1, {9, 8, 7, 255});
    nlohmann::json document = nlohmann::json::parse(texturedGlb(image).gltf());
    document["images"][0] = {{"uri", "data:image/png;base64," + base64(image)}};
    EXPECT_THAT(loadContent("a.gltf", document.dump()).images[0].rgba, ElementsAre(9, 8, 7, 255));

    const ScratchFolder folder;
    folder.write("Bilder/grüne Wiese 100%.png", image);
    document["images"][0] = {{"uri", "Bilder/gr%C3%BCne%20Wiese 100%.png"}};
    Diagnostics diagnostics;
    const GroundMesh mesh = load(folder.write("Gelände.gltf", document.dump()), {}, diagnostics);
    EXPECT_THAT(mesh.images[0].rgba, ElementsAre(9, 8, 7, 255));
    EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty());
}

TEST(GltfMaterial, NamesFormatsThatItDoesNotRead)
{
    for (const auto& [bytes, name] :
         {std::pair<std::string, std::string>("RIFFxxxxWEBPVP8 ", "WebP"),
          {"\xabKTX 20\xbb\r\n\x1a\n", "KTX2"},
          {"GIF89a", "GIF"}}) {
        Diagnostics diagnostics;
        loadContent("a.glb", texturedGlb(bytes).glb(), {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr(name)));
    }
}

TEST(GltfMaterial, DecodesNoMoreThanTheImagesOfAFileMayCost)
{
    // Ten thousand images in one view are one image.
    GlbBuilder same = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    // Each of these is separate and counts as a quarter of a megapixel: 2048 of them are decoded.
    GlbBuilder many = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    const std::string uri = "data:image/png;base64," + base64(png(1, 1, {1, 2, 3, 4}));
    for (GlbBuilder* const builder : {&same, &many}) {
        for (std::size_t i = 1; i < 2050; ++i) {
            builder->document["images"].push_back(builder == &same ? same.document["images"][0]
                                                                   : nlohmann::json{{"uri", uri}});
            builder->document["textures"].push_back({{"source", i}});
            builder->document["materials"].push_back(
                {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
        }
    }
    Diagnostics none;
    EXPECT_EQ(loadContent("a.glb", same.glb(), {}, &none).images.size(), 1U);
    EXPECT_THAT(none.warnings(), testing::IsEmpty());
    Diagnostics two;
    EXPECT_EQ(loadContent("a.glb", many.glb(), {}, &two).images.size(), 2048U);
    EXPECT_THAT(two.warnings(), ElementsAre(HasSubstr("image 2048"), HasSubstr("image 2049")));
}

TEST(GltfMaterial, WarnsOfTexturesInOtherFormats)
{
    GlbBuilder builder = texturedGlb(png(1, 1, {1, 2, 3, 4}));
    builder.document["extensionsUsed"] = {"EXT_texture_webp"};
    builder.document["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
    EXPECT_EQ(mesh.materials[0].image, GroundMaterial::noImage);
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("EXT_texture_webp")));

    // An additional plain image avoids any loss.
    builder.document["textures"][0]["source"] = 0;
    Diagnostics none;
    EXPECT_EQ(loadContent("a.glb", builder.glb(), {}, &none).materials[0].image, 0U);
    EXPECT_THAT(none.warnings(), testing::IsEmpty());
}

} // namespace
} // namespace sward::terrain
