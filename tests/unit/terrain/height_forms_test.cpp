// Heights without a header, grids of surveys, gaps, and files that are something else.

#include "core/error.h"
#include "terrain/image/channel_image.h"
#include "unit/terrain/gltf/glb_builder.h"
#include "unit/terrain/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t side = 33;

// Gentle hills in [1000, 5000].
std::vector<std::uint16_t> hillSamples()
{
    std::vector<std::uint16_t> samples;
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i)
            samples.push_back(static_cast<std::uint16_t>(3000.0 + 1500.0 * std::sin(0.2 * i) +
                                                         400.0 * std::cos(0.15 * j)));
    return samples;
}

std::string swapped(std::string bytes, std::size_t width)
{
    for (std::size_t i = 0; i + width <= bytes.size(); i += width)
        std::reverse(bytes.begin() + std::ptrdiff_t(i), bytes.begin() + std::ptrdiff_t(i + width));
    return bytes;
}

ImportSettings hillSettings()
{
    ImportSettings settings;
    settings.heightmap.size = glm::uvec2(side);
    settings.heightmap.extent = glm::dvec2(side - 1);
    settings.heightmap.height = glm::dvec2(0.0, 65.535);
    return settings;
}

std::vector<double> heightsOfHills(const std::string& name, const std::string& content,
                                   ImportSettings settings, Diagnostics& diagnostics)
{
    const GroundMesh mesh = loadContent(name, content, settings, &diagnostics);
    std::vector<double> heights;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        heights.push_back(worldPosition(mesh, i).y);
    return heights;
}

TEST(HeightForms, TheOtherByteOrderIsNoticedAndMayBeChosen)
{
    const std::string little = rawHeights(hillSamples());
    for (const char* name : {"a.r16", "a.raw", "A.RAW"}) {
        Diagnostics diagnostics;
        ImportSettings settings = hillSettings();
        const auto right = heightsOfHills(name, little, settings, diagnostics);
        EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty());
        heightsOfHills(name, swapped(little, 2), settings, diagnostics);
        EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("--endian big")));
        settings.heightmap.endian = "big";
        Diagnostics none;
        EXPECT_EQ(heightsOfHills(name, swapped(little, 2), settings, none), right);
        EXPECT_THAT(none.warnings(), testing::IsEmpty());
        heightsOfHills(name, little, settings, none);
        EXPECT_THAT(none.warnings(), Contains(HasSubstr("--endian little")));
    }
}

TEST(HeightForms, RowsMayBeFlipped)
{
    Diagnostics diagnostics;
    ImportSettings settings = hillSettings();
    const auto own = heightsOfHills("a.r16", rawHeights(hillSamples()), settings, diagnostics);
    settings.heightmap.flipRows = true;
    const auto flipped = heightsOfHills("a.r16", rawHeights(hillSamples()), settings, diagnostics);
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i)
            EXPECT_EQ(flipped[(side - 1 - j) * side + i], own[j * side + i]);
}

TEST(HeightForms, FloatsTilesAndGridsAreMetres)
{
    std::string floats;
    std::string tile;
    std::string grid = fmt::format("NCOLS {}\nnrows {}\nxllcorner 5e5\nyllcorner 4\ncellsize 2\n"
                                   "NODATA_value -7777\n",
                                   side, side);
    for (const std::uint16_t sample : hillSamples()) {
        const auto metres = static_cast<float>(sample);
        floats.append(reinterpret_cast<const char*>(&metres), 4);
        tile.append({static_cast<char>(sample >> 8), static_cast<char>(sample & 0xff)});
        grid += fmt::format("{} ", sample);
    }
    ImportSettings settings;
    settings.heightmap.extent = glm::dvec2(side - 1);
    Diagnostics diagnostics;
    const auto fromGrid = heightsOfHills("a.asc", "\xef\xbb\xbf" + grid, settings, diagnostics);
    EXPECT_EQ(heightsOfHills("a.hgt", tile, settings, diagnostics), fromGrid);
    settings.heightmap.size = glm::uvec2(side);
    EXPECT_EQ(heightsOfHills("a.r32", floats, settings, diagnostics), fromGrid);
    settings.heightmap.endian = "big";
    EXPECT_EQ(heightsOfHills("a.r32", swapped(floats, 4), settings, diagnostics), fromGrid);
    EXPECT_NEAR(fromGrid[0], 3400.0, 1.0);

    // Without --extent the grid's cells decide.
    const GroundMesh mesh = loadContent("a.asc", grid);
    EXPECT_NEAR(worldPosition(mesh, mesh.positions.size() - 1).x, side - 1, 1e-3);
}

TEST(HeightForms, GapsAreHolesOrAHint)
{
    for (const int gap : {0, 65535, 32768, 55537}) {
        std::vector<std::uint16_t> samples = hillSamples();
        for (std::uint32_t j = 5; j < 12; ++j)
            for (std::uint32_t i = 7; i < 15; ++i)
                samples[j * side + i] = static_cast<std::uint16_t>(gap);
        const std::pair<const char*, std::string> files[] = {
            {"a.r16", rawHeights(samples)}, {"a.png", greyPng({side, side}, samples, 16)}};
        for (const auto& [name, content] : files) {
            Diagnostics diagnostics;
            ImportSettings settings = hillSettings();
            const GroundMesh cliffs = loadContent(name, content, settings, &diagnostics);
            EXPECT_THAT(diagnostics.warnings(),
                        Contains(HasSubstr(fmt::format("--no-data {}", gap))));
            settings.heightmap.noData = gap;
            Diagnostics none;
            const GroundMesh holes = loadContent(name, content, settings, &none);
            EXPECT_THAT(none.warnings(), testing::IsEmpty());
            // Two corners of the gap cut only one triangle of their cell.
            EXPECT_EQ(cliffs.triangles.size() - holes.triangles.size(), 2U * 8U * 9U - 2U);
        }
    }
    Diagnostics diagnostics;
    loadContent("a.r16", rawHeights(hillSamples()), hillSettings(), &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Not(Contains(HasSubstr("--no-data"))));
}

TEST(HeightForms, AFileOfAnotherKindSaysWhatItIsUnderAnyName)
{
    using namespace std::string_literals;
    const std::pair<std::string, const char*> files[] = {
        {"\x1f\x8b\x08\0\0\0\0\0\0\x03 packed"s, "gzip"},
        {"PK\x03\x04 packed"s, "zip"},
        {"7z\xbc\xaf\x27\x1c packed"s, "7z"},
        {"\xff\xfev\0 \0"s, "UTF-16"},
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n"s, "git-LFS"},
        {"Kaydara FBX Binary  \0"s, "FBX"},
        {"BLENDER-v300"s, "Blender"},
        {"PXR-USDC"s, "USD"},
        {"#usda 1.0\n"s, "USD"},
        {"II*\0\x08\0\0\0"s, "TIFF"}};
    for (const auto& [content, word] : files)
        for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.off", "a.json",
                                 "a.png", "a.exr", "a.asc", "a.xyz"})
            try {
                loadContent(name, content);
                ADD_FAILURE() << name << " of " << word;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(word)) << name;
            }
}

// A BMP and TGAs, plain and run-length encoded, of 7 x 5 pixels.
std::vector<std::pair<std::string, std::string>> pixelFiles()
{
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = 7;
    tga[14] = 5;
    tga[16] = 24;
    std::string packed = tga;
    packed[2] = 10;
    for (int i = 0; i < 35; ++i)
        tga.append({char(i), char(2 * i), char(3 * i)});
    for (int row = 0; row < 5; ++row)
        packed.append({char(0x86), char(row), 'g', 'r'});
    std::string bmp = "BM";
    const auto word = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            bmp.push_back(char((value >> (8 * i)) & 0xffU));
    };
    for (const std::uint32_t value : {54U + 5U * 24U, 0U, 54U, 40U, 7U, 5U})
        word(value, 4);
    word(1, 2);
    word(24, 2);
    for (const std::uint32_t value : {0U, 120U, 0U, 0U, 0U, 0U})
        word(value, 4);
    for (int i = 0; i < 120; ++i)
        bmp.push_back(char(i));
    return {{"a.tga", tga}, {"b.tga", packed}, {"a.bmp", bmp}};
}

TEST(HeightForms, AnImageCutAnywhereIsRefused)
{
    const ScratchFolder folder;
    for (const auto& [name, content] : pixelFiles()) {
        EXPECT_EQ(readChannel(folder.write(name, content), 0).width, 7U) << name;
        for (std::size_t size = 1; size < content.size(); ++size) {
            // The last row of a BMP ends with filling.
            if (name == "a.bmp" && content.size() - size <= 3)
                continue;
            const std::string cut = folder.write("cut" + name, content.substr(0, size));
            EXPECT_THROW(readChannel(cut, 0), Error) << name << " " << size;
        }
    }
}

} // namespace
} // namespace sward::terrain
