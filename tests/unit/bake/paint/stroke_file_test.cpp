#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "unit/bake/paint/strokes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace sward::bake {
namespace {

using testing::HasSubstr;

Strokes parsed(const std::string& strokes)
{
    return parseStrokes(R"({"format": "sward strokes 1", "strokes": [)" + strokes + "]}", "s.json");
}

// The error of a file, its kind before it.
std::string troubleOf(const std::string& text)
{
    try {
        parseStrokes(text, "s.json");
    } catch (const Error& error) {
        return std::to_string(error.exitCode()) + " " + error.what();
    }
    return "none";
}

std::string troubleOfStrokes(const std::string& strokes)
{
    return troubleOf(R"({"format": "sward strokes 1", "strokes": [)" + strokes + "]}");
}

TEST(StrokeFile, ReadsWhatItWrites)
{
    Strokes strokes = tests::allKinds();
    for (Stroke& stroke : strokes.list)
        if (stroke.kind == StrokeKind::species)
            stroke.species = "tall \"reed\"";
    strokes.list[0].depth = 0.25;
    strokes.list[1].normals = {{0, 1000, 0}, {700, 700, -1}, {-5, 999, 3}};
    strokes.list[2].normals.clear();
    strokes.list[2].points = {{-1, 999'999'999'999, -123'456'789}};
    const std::string text = toJson(strokes);
    const Strokes back = parseStrokes(text, "back");
    EXPECT_EQ(toJson(back), text);
    EXPECT_EQ(back.list[2].points, strokes.list[2].points);
    EXPECT_EQ(hashOf(back), hashOf(strokes));
    strokes.list[8].points[0][0] += 1;
    EXPECT_NE(hashOf(back), hashOf(strokes));
    EXPECT_EQ(toJson(parsed("")), toJson(Strokes()));
    EXPECT_EQ(hashOf(Strokes()), "");
}

TEST(StrokeFile, RoundsPointsToMillimetres)
{
    const Strokes strokes =
        parsed(R"({"kind": "erase", "points": [[1.2344, -0.0006, 2e3], [0, 0.00049, 1]]})");
    const std::vector<std::array<std::int64_t, 3>> expected{{1234, -1, 2'000'000}, {0, 0, 1000}};
    EXPECT_EQ(strokes.list[0].points, expected);
}

// 30 m of a winding brush, a point each half radius, with a normal at each.
TEST(StrokeFile, HoldsALongStrokeInTwoKilobytes)
{
    Strokes strokes;
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 40; ++i)
        points.emplace_back(-117.0 + 0.76 * i, 12.3 + std::sin(0.3 * i),
                            88.0 + 3.0 * std::cos(0.2 * i));
    Stroke stroke = tests::hardStroke(StrokeKind::trodden, points, 1.5, 0.4);
    stroke.normals.clear();
    for (int i = 0; i < 40; ++i)
        stroke.normals.push_back({static_cast<std::int16_t>(100 - i), 987, -123});
    strokes.list = {stroke};
    EXPECT_LE(toJson(strokes).size(), 2048U);
}

TEST(StrokeFile, NamesWhatIsWrong)
{
    const struct {
        const char* stroke;
        std::vector<const char*> words;
    } cases[] = {
        {R"({"kind": "erase", "radius_m": 0, "points": [[0, 0, 0]]})",
         {"3 s.json: strokes[1]: radius_m", "0", "[0.001, 1000]"}},
        {R"({"kind": "erase", "radius_m": 1e9, "points": [[0, 0, 0]]})",
         {"strokes[1]: radius_m", "1000000000", "[0.001, 1000]"}},
        {R"({"kind": "erase", "radius_m": null, "points": [[0, 0, 0]]})",
         {"strokes[1]: radius_m", "null"}},
        {R"({"kind": "erase", "hardness": 1.5, "points": [[0, 0, 0]]})",
         {"strokes[1]: hardness", "1.5", "[0, 1]"}},
        {R"({"kind": "erase", "strength": -1, "points": [[0, 0, 0]]})",
         {"strokes[1]: strength", "-1", "[0, 1]"}},
        {R"({"kind": "erase", "depth_m": 0, "points": [[0, 0, 0]]})",
         {"strokes[1]: depth_m", "[0.001, 1000]"}},
        {R"({"kind": "add", "ceiling": 9, "points": [[0, 0, 0]]})",
         {"strokes[1]: ceiling", "9", "[0, 8]"}},
        {R"({"kind": "set", "density": -0.1, "points": [[0, 0, 0]]})",
         {"strokes[1]: density", "-0.1", "[0, 8]"}},
        {R"({"kind": "height", "factor": 5, "points": [[0, 0, 0]]})",
         {"strokes[1]: factor", "5", "[0.05, 4]"}},
        {R"({"kind": "dryness", "share": 2, "points": [[0, 0, 0]]})",
         {"strokes[1]: share", "2", "[0, 1]"}},
        {R"({"kind": "trodden", "lean": 2, "points": [[0, 0, 0]]})",
         {"strokes[1]: lean", "2", "[0, 1]"}},
        {R"({"kind": "species", "points": [[0, 0, 0]]})", {"strokes[1]: species is missing"}},
        {R"({"kind": "mow", "points": [[0, 0, 0]]})", {"strokes[1]: kind", "mow", "trodden"}},
        {R"({"points": [[0, 0, 0]]})", {"strokes[1]: kind is missing"}},
        {R"({"kind": "erase"})", {"strokes[1]: points are missing"}},
        {R"({"kind": "erase", "points": []})", {"strokes[1]: points", "list"}},
        {R"({"kind": "erase", "points": [[0, 0]]})", {"strokes[1]: points[0]", "[x, y, z]"}},
        {R"({"kind": "erase", "points": [[0, 0, 0], [0, 2e9, 0]]})",
         {"strokes[1]: points[1]", "2000000000", "[-1000000000, 1000000000]"}},
        {R"({"kind": "erase", "points": [[0, "x", 0]]})", {"strokes[1]: points[0]", "string"}},
        {R"({"kind": "erase", "points": [[0, 0, 0]], "normals": [[0, 0.1, 0]]})",
         {"strokes[1]: normals[0]", "0.1", "[0.5, 2]"}},
        {R"({"kind": "erase", "points": [[0, 0, 0]], "normals": [[0, 1, 0], [0, 1, 0]]})",
         {"strokes[1]: normals", "2 entries for 1 points"}},
        {R"({"kind": "erase", "ceiling": 1, "points": [[0, 0, 0]]})",
         {"strokes[1]", "unknown key \"ceiling\""}},
        {R"({"kind": "erase", "radius": 1, "points": [[0, 0, 0]]})",
         {"strokes[1]", "unknown key \"radius\"", "radius_m"}},
        {"7", {"strokes[1]", "object"}},
    };
    for (const auto& one : cases) {
        const std::string trouble = troubleOfStrokes(
            R"({"kind": "erase", "points": [[0, 0, 0]]},)" + std::string(one.stroke));
        for (const char* const word : one.words)
            EXPECT_THAT(trouble, HasSubstr(word)) << one.stroke;
    }
    EXPECT_THAT(troubleOfStrokes(R"({"kind": "erase", "points": [[0, NaN, 0]]})"),
                HasSubstr("not valid JSON"));
    EXPECT_THAT(troubleOfStrokes(R"({"kind": "erase", "points": [[0, 1e999, 0]]})"),
                HasSubstr("s.json"));
    EXPECT_EQ(troubleOf(R"({"format": "sward strokes 2", "strokes": []})"),
              "5 s.json: is \"sward strokes 2\", not \"sward strokes 1\"");
    for (const char* const none :
         {R"({"strokes": []})", "[]", "7", R"({"format": 1})", R"({"format": "strokes 1"})"})
        EXPECT_THAT(troubleOf(none), HasSubstr("3 s.json: is no stroke file"));
    EXPECT_THAT(troubleOf(R"({"format": "sward strokes 1"})"), HasSubstr("strokes: is no list"));
    EXPECT_THAT(troubleOf(R"({"format": "sward strokes 1", "strokes": [], "layer": 1})"),
                HasSubstr("unknown key \"layer\""));
}

TEST(StrokeFile, BoundsTheNumbersOfPointsAndStrokes)
{
    const auto many = [](const std::string& one, std::size_t count) {
        std::string text;
        text.reserve((one.size() + 1) * count);
        for (std::size_t i = 0; i < count; ++i)
            text += (i > 0 ? "," : "") + one;
        return text;
    };
    EXPECT_THAT(
        troubleOfStrokes(R"({"kind": "erase", "points": [)" + many("[0,0,0]", 1'000'001) + "]}"),
        HasSubstr("strokes[0]: points: has 1000001 entries, more than 1000000"));
    EXPECT_THAT(
        troubleOfStrokes(R"({"kind": "erase", "points": [)" + many("[0,0,0]", 10'000'000) + "]}"),
        HasSubstr("values, more than 8000000"));
    const std::string dab = R"({"kind":"erase","points":[[0,0,0]]})";
    EXPECT_THAT(troubleOfStrokes(many(dab, 100'001)),
                HasSubstr("has 100001 strokes, more than 100000"));
    EXPECT_EQ(parsed(many(dab, 100'000)).list.size(), 100'000U);
}

TEST(StrokeFile, FindsSpeciesByName)
{
    Strokes strokes = parsed(R"({"kind": "erase", "points": [[0, 0, 0]]},
        {"kind": "species", "species": "reed", "points": [[0, 0, 0]]})");
    const std::vector<std::string> names{"grass", "reed"};
    resolveSpecies(strokes, names);
    EXPECT_EQ(strokes.list[1].slot, 1U);
    try {
        resolveSpecies(strokes, std::span(names).first(1));
        ADD_FAILURE() << "reed was found";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "s.json: strokes[1]: species: the meadow has no \"reed\"; it "
                                   "has grass");
    }
}

} // namespace
} // namespace sward::bake
