#include "core/error.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/terrain/gltf/glb_builder.h"
#include "unit/terrain/image_files.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>
#include <zlib.h>

#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const float notANumber = std::numeric_limits<float>::quiet_NaN();

// Three samples along x, two along z.
const std::vector<std::uint16_t> six = {0, 65535, 13107, 26214, 39321, 52428};

ImportSettings mapped(const glm::dvec2& extent, const glm::dvec2& height)
{
    ImportSettings settings;
    settings.heightmap.extent = extent;
    settings.heightmap.height = height;
    return settings;
}

// Heights [m] of a 3 x 2 map, in the order of its samples.
std::vector<double> heightsOf(const GroundMesh& mesh)
{
    std::vector<double> heights;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        heights.push_back(worldPosition(mesh, i).y);
    return heights;
}

std::string messageOf(const std::string& name, const std::string& content, ErrorKind kind,
                      const ImportSettings& settings = {})
{
    try {
        loadContent(name, content, settings);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.what();
    }
    ADD_FAILURE() << name << " was read";
    return {};
}

TEST(Heightmap, LaysTheImageOverTheGroundWithItsUpperLeftAtMinusXMinusZ)
{
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("m.png", greyPng({3, 2}, six, 16),
                                        mapped({20.0, 6.0}, {-10.0, 90.0}), &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
    ASSERT_EQ(mesh.positions.size(), 6U);
    ASSERT_EQ(mesh.triangles.size(), 4U);
    const std::vector<glm::dvec3> places = {{-10, -10, -3}, {0, 90, -3}, {10, 10, -3},
                                            {-10, 30, 3},   {0, 50, 3},  {10, 70, 3}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_LT(glm::length(worldPosition(mesh, i) - places[i]), 1e-5) << i;
        EXPECT_EQ(mesh.uvs[i], glm::vec2(0.5f * static_cast<float>(i % 3), i < 3 ? 0.0f : 1.0f));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        EXPECT_GT(mesh.faceNormal(i).y, 0.0) << "fronts look up";
}

TEST(Heightmap, ReadsTheSameGroundFromEveryFormat)
{
    const glm::uvec2 size(37, 19);
    std::vector<std::uint16_t> samples;
    std::vector<float> metres;
    for (std::uint32_t i = 0; i < size.x * size.y; ++i) {
        samples.push_back(static_cast<std::uint16_t>(i * 2654435761U >> 16));
        metres.push_back(static_cast<float>(samples.back()) / 256.0f);
    }
    ImportSettings settings = mapped({36.0, 18.0}, {0.0, 65535.0 / 256.0});
    const std::string png = contentHash(loadContent("m.png", greyPng(size, samples, 16), settings));
    EXPECT_EQ(contentHash(loadContent("m.png", greyPng(size, samples, 16, true), settings)), png);
    settings.heightmap.size = size;
    EXPECT_EQ(contentHash(loadContent("m.r16", rawHeights(samples), settings)), png);
    settings.heightmap.height.reset();
    for (const bool isTiled : {false, true})
        EXPECT_EQ(
            contentHash(loadContent(
                "m.exr", floatExr(size, metres, {.channel = "Z", .isTiled = isTiled}), settings)),
            png);
}

TEST(Heightmap, TakesTheSamplesOfAnExrForMetresUnlessARangeIsGiven)
{
    const std::vector<float> samples = {0.0f, 1.0f, 0.5f, 0.25f, 0.75f, 0.125f};
    ImportSettings settings;
    settings.heightmap.extent = {2.0, 1.0};
    for (const bool isHalf : {false, true}) {
        const std::string file = floatExr({3, 2}, samples, {.isHalf = isHalf});
        EXPECT_THAT(heightsOf(loadContent("m.exr", file, settings)),
                    testing::ElementsAre(0.0, 1.0, 0.5, 0.25, 0.75, 0.125));
        EXPECT_THAT(heightsOf(loadContent("m.exr", file, mapped({2.0, 1.0}, {100.0, 108.0}))),
                    testing::ElementsAre(100.0, 108.0, 104.0, 102.0, 106.0, 101.0));
    }
}

TEST(Heightmap, WarnsOfEveryDefaultByTheNameOfItsOption)
{
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("m.png", greyPng({3, 2}, six, 16), {}, &diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 2U);
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("--extent"));
    EXPECT_THAT(diagnostics.warnings()[1], HasSubstr("--height"));
    EXPECT_NEAR(mesh.bounds().size().x, 2.0, 1e-6) << "1 m from sample to sample";
    EXPECT_NEAR(mesh.bounds().size().y, 0.2, 1e-6) << "a tenth of the longer side";
}

TEST(Heightmap, WarnsOfTerraces)
{
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("m.png", greyPng({3, 2}, {0, 255, 51, 102, 153, 204}, 8),
                                        mapped({2.0, 1.0}, {0.0, 255.0}), &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), testing::ElementsAre(HasSubstr("terraces")));
    EXPECT_THAT(heightsOf(mesh), testing::ElementsAre(0, 255, 51, 102, 153, 204));
}

TEST(Heightmap, TakesTheBrightestChannelOfAColorImage)
{
    const std::vector<std::uint8_t> rgba = {9, 8, 7, 255, 1, 2, 3, 255, 0, 5, 0, 255, 4, 4, 4, 255};
    std::string png;
    stbi_write_png_to_func(
        [](void* to, void* bytes, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                                  static_cast<std::size_t>(size));
        },
        &png, 2, 2, 4, rgba.data(), 8);
    Diagnostics diagnostics;
    const GroundMesh mesh =
        loadContent("m.png", png, mapped({1.0, 1.0}, {0.0, 255.0}), &diagnostics);
    EXPECT_THAT(heightsOf(mesh), testing::ElementsAre(9, 3, 5, 4));
    EXPECT_THAT(diagnostics.warnings(), testing::Contains(HasSubstr("colour")));
}

TEST(Heightmap, HasTheNormalsOfItsSlopes)
{
    // Heights 2x − 3z + 40 at samples 1 m apart: every difference is exact.
    std::vector<float> samples;
    for (int z = 0; z < 4; ++z)
        for (int x = 0; x < 5; ++x)
            samples.push_back(static_cast<float>(2 * x - 3 * z + 40));
    const GroundMesh mesh = loadContent("m.exr", floatExr({5, 4}, samples));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-2.0, 1.0, 3.0));
    for (const glm::vec3& n : mesh.normals)
        EXPECT_LT(glm::length(glm::dvec3(n) - normal), 1e-6);
}

TEST(Heightmap, LeavesHolesWhereAnExrHasNoHeight)
{
    for (const float nothing :
         {notANumber, std::numeric_limits<float>::infinity(), -9999.0f, -3.4028235e38f}) {
        std::vector<float> samples(25, 7.0f);
        samples[12] = nothing; // the middle
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("m.exr", floatExr({5, 5}, samples), {}, &diagnostics);
        EXPECT_EQ(mesh.triangles.size(), 32U - 6U) << "the six triangles around it";
        EXPECT_EQ(mesh.positions.size(), 24U);
        EXPECT_EQ(mesh.bounds().size().y, 0.0f);
        for (const glm::vec3& normal : mesh.normals)
            EXPECT_EQ(normal, glm::vec3(0.0f, 1.0f, 0.0f));
        EXPECT_THAT(diagnostics.warnings(), testing::Contains(HasSubstr("1 of 25 samples")));
    }
}

TEST(Heightmap, LeavesHolesWhereTheMaskIsBlack)
{
    const ScratchFolder folder;
    const std::vector<std::uint16_t> samples(std::size_t(9) * 9, 1000);
    const std::string map = folder.write("m.png", greyPng({9, 9}, samples, 16));
    ImportSettings settings = mapped({8.0, 8.0}, {0.0, 1.0});
    Diagnostics diagnostics;

    // Two by two pixels: the upper left quarter is a hole. The next mask has values 0 and 1, as
    // label images do.
    for (const std::uint16_t white : {std::uint16_t(255), std::uint16_t(1)}) {
        settings.heightmap.holeMask =
            folder.write("holes.png", greyPng({2, 2}, {0, white, white, white}, 8));
        const GroundMesh mesh = load(map, settings, diagnostics);
        EXPECT_EQ(mesh.triangles.size(), 2U * (64U - 16U));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 p = worldPosition(mesh, i);
            EXPECT_TRUE(p.x >= 0.0 || p.z >= 0.0) << p.x << " " << p.z;
        }
    }

    // A pixel for each cell, in 16 bits.
    std::vector<std::uint16_t> cells(64, 65535);
    cells[8 * 3 + 5] = 0;
    settings.heightmap.holeMask = folder.write("cells.png", greyPng({8, 8}, cells, 16));
    EXPECT_EQ(load(map, settings, diagnostics).triangles.size(), 126U);

    settings.heightmap.holeMask = folder.write("black.png", greyPng({2, 2}, {0, 0, 0, 0}, 8));
    try {
        load(map, settings, diagnostics);
        ADD_FAILURE() << "ground of nothing but holes";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), HasSubstr("hole"));
    }
    settings.heightmap.holeMask = folder.path("none.png").string();
    EXPECT_THROW(load(map, settings, diagnostics), Error);
    settings.heightmap.holeMask = folder.write("text.jpg", "no image");
    EXPECT_THROW(load(map, settings, diagnostics), Error);
}

TEST(Heightmap, NamesTheOptionThatIsMissingOrDoesNotFit)
{
    EXPECT_THAT(messageOf("m.r16", rawHeights(six), ErrorKind::usage), HasSubstr("--size"));
    ImportSettings settings;
    settings.heightmap.size = {2, 2};
    EXPECT_THAT(messageOf("m.r16", rawHeights(six), ErrorKind::input, settings),
                HasSubstr("--size 2x2 needs 8 bytes, the file has 12"));
    EXPECT_THAT(messageOf("m.png", greyPng({3, 2}, six, 16), ErrorKind::usage, settings),
                HasSubstr("--size is 2x2, but the image has 3x2"));
    settings.heightmap.size = {32768, 32768};
    EXPECT_THAT(messageOf("m.r16", rawHeights(six), ErrorKind::usage, settings),
                HasSubstr("17000000"));
    for (const glm::dvec2 extent : {glm::dvec2(0.0, 1.0), glm::dvec2(1.0, 1e9)})
        EXPECT_THAT(messageOf("m.png", greyPng({3, 2}, six, 16), ErrorKind::usage,
                              mapped(extent, {0.0, 1.0})),
                    HasSubstr("--extent"));
    EXPECT_THAT(messageOf("m.png", greyPng({3, 2}, six, 16), ErrorKind::usage,
                          mapped({1.0, 1.0}, {0.0, 1e12})),
                HasSubstr("--height"));
}

TEST(Heightmap, RefusesSizesOutOfBoundsBeforeAnythingIsMade)
{
    EXPECT_THROW(requireHeightmapSize(1, 10, "m"), Error);
    EXPECT_THROW(requireHeightmapSize(heightmapSideLimit + 1, 2, "m"), Error);
    EXPECT_THROW(requireHeightmapSize(32768, 32768, "m"), Error);
    EXPECT_NO_THROW(requireHeightmapSize(4097, 4097, "m"));
    EXPECT_NO_THROW(requireHeightmapSize(3163, 3163, "m"));

    EXPECT_THAT(messageOf("m.png", greyPng({1, 6}, six, 16), ErrorKind::input), HasSubstr("1x6"));

    // A small file whose header declares 30000 x 30000, 1.8 GB, with valid checksums.
    std::string png = greyPng({3, 2}, six, 16);
    for (const std::size_t at : {16U, 20U})
        png.replace(at, 4, std::string("\0\0\x75\x30", 4));
    const auto crc = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const unsigned char*>(png.data()) + 12, 17));
    for (unsigned i = 0; i < 4; ++i)
        png[29 + i] = static_cast<char>((crc >> (24 - 8 * i)) & 0xffU);
    EXPECT_THAT(messageOf("m.png", png, ErrorKind::input), HasSubstr("30000x30000"));

    // The same of an EXR: the data window ends at 29999.
    std::string exr = floatExr({3, 2}, std::vector<float>(6, 1.0f));
    const std::size_t window = exr.find("dataWindow");
    ASSERT_NE(window, std::string::npos);
    const std::size_t end = window + std::string("dataWindow.box2i.xxxx").size() + 8;
    exr.replace(end, 8, std::string("\x2f\x75\0\0\x2f\x75\0\0", 8));
    EXPECT_THAT(messageOf("m.exr", exr, ErrorKind::input), HasSubstr("30000x30000"));
}

TEST(Heightmap, DoesNotUnpackWhatLiesBehindTheLastRow)
{
    // Two rows of three samples, then 256 MB of zeros, in 260 kB.
    std::vector<unsigned char> rows(std::size_t(1) << 28, 0);
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    std::string packed(size, '\0');
    ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(packed.data()), &size, rows.data(),
                        static_cast<uLong>(rows.size()), 1),
              Z_OK);
    packed.resize(size);
    const auto word = [](std::size_t value) {
        std::string bytes;
        for (unsigned shift = 32; shift > 0; shift -= 8)
            bytes.push_back(static_cast<char>((value >> (shift - 8)) & 0xffU));
        return bytes;
    };
    const std::string body = "IDAT" + packed;
    const std::string sound = greyPng({3, 2}, six, 16);
    const std::string png = sound.substr(0, sound.find("IDAT") - 4) + word(packed.size()) + body +
                            word(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                       static_cast<uInt>(body.size()))) +
                            sound.substr(sound.find("IEND") - 4);
    EXPECT_THAT(messageOf("m.png", png, ErrorKind::input), HasSubstr("behind its last row"));
}

TEST(Heightmap, RefusesEveryTruncation)
{
    const std::vector<std::string> files = {
        greyPng({3, 2}, six, 16), greyPng({3, 2}, six, 8, true),
        floatExr({3, 2}, std::vector<float>(6, 1.0f)),
        floatExr({3, 2}, std::vector<float>(6, 1.0f), {.isTiled = true})};
    for (std::size_t f = 0; f < files.size(); ++f)
        for (std::size_t length = 0; length < files[f].size(); ++length)
            messageOf(f < 2 ? "m.png" : "m.exr", files[f].substr(0, length), ErrorKind::input);
}

TEST(Heightmap, SurvivesEveryFlippedByte)
{
    const std::vector<std::string> files = {
        greyPng({3, 2}, six, 16), floatExr({3, 2}, std::vector<float>(6, 1.0f)),
        floatExr({3, 2}, std::vector<float>(6, 1.0f), {.isTiled = true})};
    for (std::size_t f = 0; f < files.size(); ++f)
        for (std::size_t at = 0; at < files[f].size(); ++at)
            for (const unsigned mask : {0x01U, 0x10U, 0x80U}) {
                std::string damaged = files[f];
                damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ mask);
                try {
                    loadContent(f == 0 ? "m.png" : "m.exr", damaged);
                } catch (const Error& error) {
                    EXPECT_THAT(error.what(), HasSubstr("m."));
                }
            }
}

TEST(Heightmap, LiesBesideTheRecipeThatNamesIt)
{
    const ScratchFolder folder;
    folder.write("maps/m.r16", rawHeights(six));
    folder.write("maps/holes.png", greyPng({2, 1}, {0, 255}, 8));
    Diagnostics diagnostics;
    const GroundMesh mesh =
        load(folder.write("r.json", R"({"kind": "heightmap", "file": "maps/m.r16", "size": [3, 2],
             "extent": [20, 6], "height": [-10, 90], "hole_mask": "maps/holes.png"})"),
             {}, diagnostics);
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_NEAR(worldPosition(mesh, 0).y, 90.0, 1e-5);

    const auto refused = [&](const std::string& text, const std::string& word) {
        try {
            load(folder.write("r.json", text), {}, diagnostics);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_THAT(error.what(), HasSubstr(word));
        }
    };
    refused(R"({"kind": "heightmap"})", "file");
    refused(R"({"kind": "heightmap", "file": "mesh.obj"})", "mesh.obj");
    refused(R"({"kind": "heightmap", "file": "maps/m.r16"})", "size");
    refused(R"({"kind": "heightmap", "file": "maps/m.r16", "size": [3, 3]})", "18 bytes");
    refused(R"({"kind": "heightmap", "file": "maps/m.r16", "size": [3, 2], "height": [9, 1]})",
            "height");
}

TEST(Heightmap, IsTurnedAndScaledLikeAnyGround)
{
    ImportSettings settings = mapped({20.0, 6.0}, {0.0, 100.0});
    settings.units = "cm";
    const GroundMesh mesh = loadContent("m.png", greyPng({3, 2}, six, 16), settings);
    EXPECT_NEAR(mesh.bounds().size().x, 0.2, 1e-6);
    EXPECT_NEAR(mesh.bounds().size().y, 1.0, 1e-6);
}

} // namespace
} // namespace sward::terrain
