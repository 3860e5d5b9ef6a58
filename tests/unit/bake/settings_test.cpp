#include "bake/settings.h"
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
    EXPECT_THROW(parseMask("vertex-color"), Error);
    EXPECT_THROW(parseMask("vertex-color:Q"), Error);
    EXPECT_THROW(parseMask("vertex-color:R:inverted"), Error);
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
