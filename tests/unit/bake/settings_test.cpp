#include "bake/settings/settings.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace sward::bake {
namespace {

const SoftRange full{0.0, 180.0, 0.0};

TEST(SoftRange, IsOneInsideAndFallsToZeroOverItsEdge)
{
    const SoftRange range{10.0, 20.0, 5.0};
    EXPECT_EQ(range.weight(15.0), 1.0);
    EXPECT_EQ(range.weight(10.0), 1.0);
    EXPECT_DOUBLE_EQ(range.weight(22.5), 0.5);
    EXPECT_DOUBLE_EQ(range.weight(9.0), 0.8);
    EXPECT_EQ(range.weight(25.0), 0.0);
    EXPECT_EQ((SoftRange{10.0, 20.0, 0.0}.weight(20.001)), 0.0);
}

TEST(Settings, ReadRanges)
{
    const SoftRange range = parseSoftRange("--slope", "0:40~5", full);
    EXPECT_EQ(range.low, 0.0);
    EXPECT_EQ(range.high, 40.0);
    EXPECT_EQ(range.soft, 5.0);
    EXPECT_EQ(parseSoftRange("--slope", ":40", full).low, 0.0);
    EXPECT_EQ(parseSoftRange("--slope", "30:", full).high, 180.0);
    EXPECT_EQ(parseSoftRange("--altitude", "-5.5:1e3", full).low, -5.5);
    for (const char* wrong :
         {"", "40", "40:30", "a:b", "0:40~x", "0:40~-1", "0:nan", "0:1:2", "1:2~3~4"})
        EXPECT_THROW(parseSoftRange("--slope", wrong, full), Error) << wrong;
}

TEST(Settings, ReadGroundUp)
{
    EXPECT_EQ(parseGroundUp("y").direction, glm::dvec3(0, 1, 0));
    EXPECT_EQ(parseGroundUp("-z").direction, glm::dvec3(0, 0, -1));
    EXPECT_TRUE(parseGroundUp("radial").radial);
    EXPECT_EQ(parseGroundUp("radial:1,-2,3.5").centre, glm::dvec3(1, -2, 3.5));
    for (const char* wrong : {"", "w", "yy", "--y", "radial:1,2", "radial:a,b,c", "radialx"})
        EXPECT_THROW(parseGroundUp(wrong), Error) << wrong;
}

TEST(Settings, ReadAlignmentSidesAndMasks)
{
    EXPECT_EQ(parseAlignment("normal").vertical, 0.0);
    EXPECT_EQ(parseAlignment("vertical").vertical, 1.0);
    EXPECT_EQ(parseAlignment("blend:0.25").vertical, 0.25);
    EXPECT_THROW(parseAlignment("blend:2"), Error);
    EXPECT_THROW(parseAlignment("up"), Error);
    EXPECT_EQ(parseSides("both"), Sides::both);
    EXPECT_THROW(parseSides("top"), Error);
    EXPECT_EQ(parseMask("vertex-color:G").channel, 1);
    EXPECT_TRUE(parseMask("vertex-color:A:invert").invert);
    EXPECT_EQ(parseMask("texture:a:b.png").channel, 0);
    EXPECT_EQ(parseMask("texture:a:b.png").file, "a:b.png");
    EXPECT_EQ(parseMask("texture:m.tga:B:invert").channel, 2);
    for (const char* text : {"vertex-color:B", "texture:masks/a b.png:R:invert",
                             "material-texture:A", "material-texture:G:invert"})
        EXPECT_EQ(textOf(parseMask(text)), text);
    for (const char* wrong : {"vertex-color", "vertex-color:Q", "vertex-color:R:inverted",
                              "texture", "texture:", "material-texture", "R", ""})
        EXPECT_THROW(parseMask(wrong), Error) << wrong;
}

TEST(Settings, ReadSoftMinimums)
{
    // Nothing up to 2, everything from 2.5 on.
    const SoftRange range = parseSoftMinimum("--border", "2~0.5");
    EXPECT_EQ(range.weight(2.0), 0.0);
    EXPECT_EQ(range.weight(2.25), 0.5);
    EXPECT_EQ(range.weight(2.5), 1.0);
    EXPECT_EQ(parseSoftMinimum("--above-water", "-3").low, -3.0);
    for (const char* wrong : {"", "a", "1:2", "1~", "1~-1", "1~2~3", "nan"})
        EXPECT_THROW(parseSoftMinimum("--border", wrong), Error) << wrong;
}

TEST(Settings, WriteSoftRangesAsTheyAreRead)
{
    for (const char* text : {":", "0:30~5", "-1.5:", ":0.25", "1:2"})
        EXPECT_EQ(textOf(*readSoftRange(text, SoftRange())), text);
}

TEST(Settings, ReadExcludedAreas)
{
    EXPECT_EQ(parseExcludedArea("pond.glb").margin, 0.0);
    for (const char* text : {"pond.glb:1.5", "pond.glb:margin 1.5", "pond.glb:margin=1.5"}) {
        EXPECT_EQ(parseExcludedArea(text).file, "pond.glb");
        EXPECT_EQ(parseExcludedArea(text).margin, 1.5);
    }
    for (const char* wrong : {"pond.glb:", "pond.glb:-1", "pond.glb:margin", "pond.glb:far", ":1"})
        EXPECT_THROW(parseExcludedArea(wrong), Error) << wrong;
}

TEST(GroundUp, PointsAwayFromThePlanetsCentre)
{
    GroundUp up;
    up.radial = true;
    up.centre = glm::dvec3(1, 2, 3);
    EXPECT_EQ(up.at(glm::dvec3(1, 2, 8)), glm::dvec3(0, 0, 1));
    EXPECT_EQ(up.at(glm::dvec3(1, -7, 3)), glm::dvec3(0, -1, 0));
}

} // namespace
} // namespace sward::bake
