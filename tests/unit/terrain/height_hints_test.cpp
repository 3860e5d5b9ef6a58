// What a heightmap's header, name, values and transparency say besides its heights.

#include "core/error.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/image/channel_image.h"
#include "unit/terrain/gltf/glb_builder.h"
#include "unit/terrain/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace sward::terrain {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

glm::dvec2 extentOf(const GroundMesh& mesh)
{
    const glm::vec3 size = mesh.bounds().size();
    return {double(size.x), double(size.z)};
}

// A grid of 5 columns and 4 rows, its heights from `low` to `low` + 19·`step`.
std::string grid(const std::string& header, double low, double step)
{
    std::string text = "ncols 5\nnrows 4\n" + header + "\n";
    for (int i = 0; i < 20; ++i)
        text += fmt::format("{}{}", low + step * i, i % 5 == 4 ? "\n" : " ");
    return text;
}

TEST(HeightHints, CellsOfAGridNeedNotBeSquare)
{
    EXPECT_EQ(extentOf(loadContent("a.asc", grid("dx 10\ndy 20", 0.0, 0.1))),
              glm::dvec2(40.0, 60.0));
    EXPECT_EQ(extentOf(loadContent("a.asc", grid("DY 0.5\nDX 2", 0.0, 0.1))), glm::dvec2(8.0, 1.5));
    EXPECT_EQ(extentOf(loadContent("a.asc", grid("cellsize 3", 0.0, 0.1))), glm::dvec2(12.0, 9.0));
    Diagnostics diagnostics;
    loadContent("a.asc", grid("dx 10", 0.0, 0.1), {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("dy is missing")));
    loadContent("a.asc", grid("dx 10\ndy 0", 0.0, 0.1), {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("have no size")));
}

TEST(HeightHints, EachKeyOfAGridIsGivenOnce)
{
    EXPECT_THAT(inputErrorOf("a.asc", grid("cellsize 2\nNCOLS 7", 0.0, 0.1)),
                HasSubstr("line 4: ncols is given twice"));
    EXPECT_THAT(inputErrorOf("a.asc", "nrows 2\ncellsize 1\n1 2\n3 4\n"),
                HasSubstr("ncols is missing"));
    EXPECT_THAT(inputErrorOf("a.asc", "ncols 2\n1 2\n3 4\n"), HasSubstr("nrows is missing"));
}

TEST(HeightHints, DegreesAreToldFromMetresByWhatIsPlausible)
{
    const std::string alps = "xllcorner 7\nyllcorner 46\n";
    const struct {
        std::string content;
        bool isInDegrees;
    } grids[] = {
        {grid(alps + "cellsize 0.0083333", 400.0, 10.0), true},
        {grid(alps + "cellsize 0.0833333", 400.0, 10.0), true},
        {grid(alps + "cellsize 0.0833333", 0.0, 0.001), true}, // no one writes 5' in metres
        {grid(alps + "cellsize 0.25", 400.0, 10.0), true},
        {grid(alps + "dx 1\ndy 0.5", 400.0, 10.0), true},
        {grid(alps + "cellsize 1", 0.0, 0.1), false},
        {grid(alps + "dx 0.25\ndy 0.0833333", 0.0, 0.001), true},
        {grid("cellsize 0.25", 0.0, 0.01), false},
        // Steep ground, and cells of thirds, around an origin of its own.
        {grid("xllcorner 0\nyllcorner 0\ncellsize 0.3333333", 0.0, 0.1), false},
        {grid("cellsize 0.1666667", 0.0, 0.01), false},
        {grid(alps + "cellsize 2", 0.0, 5.0), false},
        {grid("xllcorner 691000\nyllcorner 5337000\ncellsize 0.5", 400.0, 10.0), false}};
    for (const auto& one : grids) {
        Diagnostics diagnostics;
        loadContent("a.asc", one.content, {}, &diagnostics);
        if (one.isInDegrees)
            EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("in degrees"))) << one.content;
        else
            EXPECT_THAT(diagnostics.warnings(), Not(Contains(HasSubstr("in degrees"))))
                << one.content;
    }
}

TEST(HeightHints, NumbersTooManyOrTooFewAreAnError)
{
    const std::string right = grid("cellsize 1", 0.0, 0.1);
    EXPECT_EQ(inputErrorOf("a.asc", right), "it was read");
    EXPECT_EQ(inputErrorOf("a.asc", right + " \r\n\x1a"), "it was read");
    EXPECT_THAT(inputErrorOf("a.asc", right + "1 2 3 4 5\n"), HasSubstr("5 numbers are left over"));
    EXPECT_THAT(inputErrorOf("a.asc", right + "7"), HasSubstr("1 numbers are left over"));
    EXPECT_THAT(inputErrorOf("a.asc", right.substr(0, right.rfind(' '))),
                HasSubstr("truncated: 19"));
    // Rows of six where five are announced.
    std::string wide = "ncols 5\nnrows 4\ncellsize 1\n";
    for (int i = 0; i < 4; ++i)
        wide += "1 2 3 4 5 6\n";
    EXPECT_THAT(inputErrorOf("a.asc", wide), HasSubstr("its first line has 6"));
    // As many as announced, in lines that shear.
    std::string sheared = "ncols 6\nnrows 4\ncellsize 1\n";
    for (int i = 0; i < 6; ++i)
        sheared += "1 2 3 4\n";
    Diagnostics diagnostics;
    loadContent("a.asc", sheared, {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("exchanged")));
}

TEST(HeightHints, ATileIsAsWideAsItsNameSays)
{
    std::string tile;
    for (int i = 0; i < 25; ++i)
        tile.append({'\0', static_cast<char>(i)});
    const auto wide = [&](const std::string& name) { return extentOf(loadContent(name, tile)).x; };
    // Lengths of a degree of longitude on WGS 84, from tables.
    EXPECT_NEAR(wide("N60E010.hgt"), 55'800.0, 10.0);
    EXPECT_NEAR(wide("s60w010.HGT"), 55'800.0, 10.0);
    EXPECT_NEAR(wide("N30E100.SRTMGL1.hgt"), 96'486.0, 10.0);
    EXPECT_NEAR(wide("S45W000.hgt"), 78'847.0, 10.0);
    EXPECT_NEAR(wide("N00E000.hgt"), 111'320.0, 10.0);
    for (const char* const name : {"tile.hgt", "N6E010.hgt", "N60E0101.hgt", "N90E010.hgt"})
        EXPECT_NEAR(wide(name), 111'132.0, 1.0) << name;
    EXPECT_NEAR(extentOf(loadContent("N60E010.hgt", tile)).y, 111'132.0, 1.0);
    ImportSettings settings;
    settings.heightmap.extent = glm::dvec2(10.0, 20.0);
    EXPECT_EQ(extentOf(loadContent("N60E010.hgt", tile, settings)), glm::dvec2(10.0, 20.0));
}

std::vector<std::uint16_t> samplesOf(const std::function<int(int)>& value)
{
    std::vector<std::uint16_t> samples;
    for (int i = 0; i < 40 * 40; ++i)
        samples.push_back(static_cast<std::uint16_t>(value(i)));
    return samples;
}

TEST(HeightHints, FewOfTheFormatsValuesAreTold)
{
    const struct {
        std::vector<std::uint16_t> samples;
        const char* says;
    } maps[] = {{samplesOf([](int i) { return i % 256; }), "0.389 % of the range"},
                {samplesOf([](int i) { return i % 256 * 257; }), "8 bits in 16"},
                {samplesOf([](int i) { return i % 256 * 256; }), "8 bits in 16"},
                {samplesOf([](int i) { return 30'000 + i / 2; }), "% of the range"},
                {samplesOf([](int i) { return i * 40; }), ""}};
    for (const auto& one : maps)
        for (const bool isRaw : {false, true}) {
            Diagnostics diagnostics;
            ImportSettings settings;
            settings.heightmap.size = glm::uvec2(40U);
            settings.heightmap.extent = glm::dvec2(40.0);
            settings.heightmap.height = glm::dvec2(0.0, 1.0);
            loadContent(isRaw ? "a.r16" : "a.png",
                        isRaw ? rawHeights(one.samples) : greyPng({40, 40}, one.samples, 16),
                        settings, &diagnostics);
            if (*one.says == '\0')
                EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty());
            else
                EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr(one.says)));
        }
    // Shares of a range where metres are.
    std::vector<float> shares;
    for (int i = 0; i < 1600; ++i)
        shares.push_back(static_cast<float>(i) / 1600.0f);
    Diagnostics diagnostics;
    loadContent("a.exr", floatExr({40, 40}, shares), {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("shares of a range")));
}

TEST(HeightHints, ColorsThatStandForHeightsAreProposedAndDecoded)
{
    // A slope from 100 m to 131 m in steps of half a metre, in both encodings.
    std::vector<std::uint8_t> terrarium;
    std::vector<std::uint8_t> terrainRgb;
    std::vector<double> heights;
    for (int i = 0; i < 64; ++i) {
        const double height = 100.0 + 0.5 * (i % 8 + i / 8);
        heights.push_back(height);
        const int shifted = static_cast<int>((height + 32768.0) * 256.0);
        for (const int byte : {shifted >> 16, shifted >> 8 & 255, shifted & 255})
            terrarium.push_back(static_cast<std::uint8_t>(byte));
        const int tenths = static_cast<int>((height + 10'000.0) * 10.0 + 0.5);
        for (const int byte : {tenths >> 16, tenths >> 8 & 255, tenths & 255})
            terrainRgb.push_back(static_cast<std::uint8_t>(byte));
    }
    for (const auto& [name, pixels] :
         {std::pair("terrarium", terrarium), std::pair("terrain-rgb", terrainRgb)}) {
        const std::string png = colorPng({8, 8}, 3, pixels);
        Diagnostics diagnostics;
        loadContent("a.png", png, {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(),
                    Contains(HasSubstr(fmt::format("try --encoding {}", name))));
        ImportSettings settings;
        settings.heightmap.encoding = name;
        const GroundMesh mesh = loadContent("a.png", png, settings);
        for (std::size_t i = 0; i < heights.size(); ++i)
            EXPECT_NEAR(worldPosition(mesh, i).y, heights[i], 1e-3) << name;
    }
    ImportSettings wrong;
    wrong.heightmap.encoding = "terrariun";
    EXPECT_THROW(loadContent("a.png", colorPng({8, 8}, 3, terrarium), wrong), Error);
    wrong.heightmap.encoding = "terrarium";
    EXPECT_THROW(loadContent("a.png", greyPng({2, 2}, {1, 2, 3, 4}, 16), wrong), Error);
}

TEST(HeightHints, WhatIsTransparentIsAHole)
{
    // 4 x 4 of grey and alpha, and of colours; the four in the middle are transparent.
    for (const int channels : {2, 4}) {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 16; ++i) {
            const bool isMiddle = i % 4 > 0 && i % 4 < 3 && i / 4 > 0 && i / 4 < 3;
            for (int c = 0; c + 1 < channels; ++c)
                pixels.push_back(200);
            pixels.push_back(isMiddle ? 0 : 255);
        }
        const std::string png = colorPng({4, 4}, channels, pixels);
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.png", png, {}, &diagnostics);
        EXPECT_EQ(mesh.triangles.size(), 2U) << channels; // at two corners
        EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("4 of 16 samples are transparent")));

        // As a mask over a level ground of 4 x 4 cells.
        const ScratchFolder folder;
        ImportSettings settings;
        settings.heightmap.holeMask = folder.write("hole.png", png);
        const GroundMesh masked = loadContent(
            "level.png", greyPng({5, 5}, std::vector<std::uint16_t>(25, 7), 16), settings);
        EXPECT_EQ(masked.triangles.size(), 2U * 12U) << channels;
        // As a mask of a channel it says that alpha hides nothing.
        EXPECT_EQ(readChannel(settings.heightmap.holeMask, 0).transparent, 4U);
        EXPECT_EQ(readChannel(settings.heightmap.holeMask, 3).transparent, 0U);
    }
    // What is wholly transparent is taken as it is.
    Diagnostics diagnostics;
    const GroundMesh mesh =
        loadContent("a.png", colorPng({2, 2}, 2, {1, 0, 2, 0, 3, 0, 4, 0}), {}, &diagnostics);
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("transparency is ignored")));
}

TEST(HeightHints, AlphaBelowHalfIsAHoleInEachFormat)
{
    // A channel A of an EXR: a corner is transparent, then all.
    const std::vector<float> heights = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.0f, 9.0f};
    ExrLook look;
    look.alpha.assign(9, 1.0f);
    look.alpha[0] = 0.4f;
    EXPECT_EQ(loadContent("a.exr", floatExr({3, 3}, heights, look)).triangles.size(), 7U);
    look.alpha.assign(9, 0.0f);
    Diagnostics diagnostics;
    EXPECT_EQ(
        loadContent("a.exr", floatExr({3, 3}, heights, look), {}, &diagnostics).triangles.size(),
        8U);
    EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("transparency is ignored")));

    // White at an alpha of 100 hides more than dark grey does.
    std::vector<std::uint8_t> mask;
    for (int i = 0; i < 16; ++i)
        for (const int byte :
             i == 5 ? std::array{255, 255, 255, 100} : std::array{150, 150, 150, 255})
            mask.push_back(static_cast<std::uint8_t>(byte));
    const ScratchFolder folder;
    ImportSettings settings;
    settings.heightmap.holeMask = folder.write("mask.png", colorPng({4, 4}, 4, mask));
    const std::string level = greyPng({5, 5}, std::vector<std::uint16_t>(25, 7), 16);
    EXPECT_EQ(loadContent("level.png", level, settings).triangles.size(), 2U * 15U);

    // A mask that cannot be decoded says why.
    settings.heightmap.holeMask = folder.write("mask.bmp", "GIF89a and more than a few bytes");
    try {
        loadContent("level.png", level, settings);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), HasSubstr("GIF"));
    }
}

TEST(HeightHints, BlackOfEncodedHeightsIsNoData)
{
    // A slope in terrarium, its first column black, or transparent besides.
    for (const int channels : {3, 4}) {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 64; ++i) {
            const int shifted = (100 + 32768) * 256 + 128 * (i % 8 + i / 8);
            const bool isGap = i % 8 == 0;
            for (const int byte : {shifted >> 16, shifted >> 8 & 255, shifted & 255})
                pixels.push_back(static_cast<std::uint8_t>(isGap ? 0 : byte));
            if (channels == 4)
                pixels.push_back(isGap ? 0 : 255);
        }
        const std::string png = colorPng({8, 8}, channels, pixels);
        Diagnostics diagnostics;
        loadContent("a.png", png, {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("try --encoding terrarium")));
        ImportSettings settings;
        settings.heightmap.encoding = "terrarium";
        Diagnostics decoded;
        EXPECT_EQ(loadContent("a.png", png, settings, &decoded).triangles.size(), 2U * 6U * 7U);
        EXPECT_THAT(decoded.warnings(), Contains(HasSubstr("8 of 64 samples have no height")));
        EXPECT_THAT(decoded.warnings(), Not(Contains(HasSubstr("are transparent"))));

        settings.heightmap.height = glm::dvec2(0.0, 50.0);
        try {
            loadContent("a.png", png, settings);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            EXPECT_THAT(error.what(), HasSubstr("--encoding"));
            EXPECT_THAT(error.what(), HasSubstr("--height"));
        }
    }
}

TEST(HeightHints, ARangeForMetresIsTold)
{
    ImportSettings settings;
    settings.heightmap.height = glm::dvec2(0.0, 50.0);
    for (const double step : {0.05, 1.0}) {
        Diagnostics diagnostics;
        loadContent("a.asc", grid("cellsize 1", 0.0, step), settings, &diagnostics);
        if (step < 1.0)
            EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty());
        else
            EXPECT_THAT(diagnostics.warnings(), Contains(HasSubstr("the values 0 and 1")));
    }
}

TEST(HeightHints, ATileOfTheNorthMayHaveHalfTheColumns)
{
    const GroundMesh mesh =
        loadContent("N60E010.hgt", std::string(std::size_t(2) * 1801 * 3601, '\0'));
    EXPECT_EQ(mesh.positions.size(), std::size_t(1801) * 3601);
    EXPECT_NEAR(extentOf(mesh).x, 55'800.0, 10.0);
    EXPECT_NEAR(extentOf(mesh).y, 111'132.0, 1.0);
}

} // namespace
} // namespace sward::terrain
