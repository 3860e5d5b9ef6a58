#include "core/error.h"
#include "core/json/json_check.h"
#include "core/json/settings_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace sward {
namespace {

// The message that a text is refused with; empty if it is taken.
std::string complaint(const std::string& text)
{
    try {
        parseJson(text, "f.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

struct Wrong {
    std::string text;
    const char* says;
};

TEST(JsonCheck, NamesAKeyThatStandsTwiceAndBothPlaces)
{
    EXPECT_EQ(complaint("{\"a\": 1,\n \"b\": {\"c\": 2},\n  \"a\": 3}"),
              "f.json: line 3, column 3: the key \"a\" stands twice in one object, first at line "
              "1, column 2");
    // However it is written, and however deep it stands.
    EXPECT_NE(complaint(R"([{"x": {"\u0061b": 1, "ab": 2}}])").find("\"ab\" stands twice"),
              std::string::npos);
    EXPECT_NE(complaint(R"({"\ud83c\udf3f": 1, "🌿": 2})").find("stands twice"), std::string::npos);
    // One key in several objects is none that stands twice.
    EXPECT_EQ(complaint(R"([{"a": {"a": 1}}, {"a": 2}, {"A": 1, "a": 2, "\\u0061": 3}])"), "");
}

TEST(JsonCheck, SaysInPlainWordsWhatIsWrongAndWhere)
{
    const Wrong wrong[] = {
        {"", "it is empty"},
        {"  \n", "it is empty"},
        {"{\"a\": 1,\n}", "line 1, column 8: a comma before \"}\", with no value behind it"},
        {"[1, 2,\n 3,]", "line 2, column 3: a comma before \"]\""},
        {"[1 2]", "line 1, column 4: expected a comma or \"]\" of the array that opens at line 1, column 1, found "
                  "\"2\""},
        {"{\"a\" 1}", "expected \":\" behind the key \"a\", found \"1\""},
        {"{a: 1}", "expected a key in double quotes, found \"a\""},
        {"{'a': 1}", "expected a key in double quotes, found \"'\""},
        {"['a']", "those of JSON are in double quotes"},
        {"{\"a\": }", "a value is missing before \"}\""},
        {"[NaN]", "expected a value, found \"NaN\""},
        {"[+1]", "expected a value, found \"+\""},
        {"[.5]", "expected a value, found \".\""},
        {"[01]", "it begins with a needless 0"},
        {"[1.]", "no digit follows its point"},
        {"[1e]", "no digit follows its exponent"},
        {"[0x10]", "letters or a second point follow it"},
        {"[1e999]", "is too large for a number"},
        {"[\"a\nb\"]", "a line ends inside a text"},
        {"[\"\\q\"]", "JSON has \\\\"},
        {"[\"\\u12\"]", "four hexadecimal digits"},
        {"[\"\\ud800\"]", "half of a surrogate pair"},
        {"[\"\xff\"]", "not UTF-8"},
        {"[\"\xc0\x80\"]", "not UTF-8"},
        {"[\"a", "truncated"},
        {"{\"a\": [1,\n", "truncated: the text ends before the array that opens at"},
        {"// no\n{}", "a comment"},
        {"{} x", "\"x\" follows the end"}};
    for (const Wrong& one : wrong) {
        const std::string said = complaint(one.text);
        EXPECT_NE(said.find(one.says), std::string::npos) << one.text << ": " << said;
        EXPECT_EQ(said.find("exception"), std::string::npos) << said;
        EXPECT_EQ(said.find("f.json: "), 0u) << said;
    }
}

TEST(JsonCheck, AgreesWithTheParserOnWhatIsJson)
{
    // Every text of few pieces, joined in every way.
    const std::string pieces[] = {"{", "}", "[", "]", ",", ":", "\"a\"", "1", "-0.5e-3", "true", " "};
    constexpr std::size_t count = std::size(pieces);
    std::size_t valid = 0;
    for (std::size_t n = 0; n < count * count * count * count * count; ++n) {
        std::string text;
        for (std::size_t rest = n, i = 0; i < 5; ++i, rest /= count)
            text += pieces[rest % count];
        bool isTaken = true;
        try {
            requireJson(text, "f");
        } catch (const Error&) {
            isTaken = false;
        }
        valid += isTaken ? 1 : 0;
        ASSERT_EQ(isTaken, nlohmann::json::accept(text)) << text;
    }
    EXPECT_GT(valid, 100u);
}

TEST(JsonCheck, TakesEveryCharacterOfUtf8)
{
    EXPECT_EQ(complaint("\xef\xbb\xbf{\"grün\": [\"草\", \"🌿\", \"\\ud83c\\udf3f\", \"\\/\\b\"]}"), "");
    EXPECT_EQ(complaint("[1e-999, -0, 0.0, 1E+2, 123456789012345678901234567890]"), "");
}

TEST(ColorOfHex, IsLinearLightOfAnSrgbColor)
{
    EXPECT_EQ(colorOfHex("#ffffff"), glm::vec3(1.0f));
    EXPECT_EQ(colorOfHex("#000000"), glm::vec3(0.0f));
    // IEC 61966-2-1: 128/255 is 0.215861 of white.
    const auto color = colorOfHex("#80FF0a");
    ASSERT_TRUE(color);
    EXPECT_EQ(color->x, 0.215861f);
    EXPECT_EQ(color->y, 1.0f);
    EXPECT_EQ(color->z, 0.003035f);
    for (const char* text : {"", "#", "#fff", "#12345", "#1234567", "#12345g", "123456", "#+12345"})
        EXPECT_FALSE(colorOfHex(text)) << text;
}

TEST(SettingsReader, TakesOneNumberForARangeAndATextForAColor)
{
    const auto object = parseJson(
        R"({"one": 2, "two": [1, 3], "three": [1, 2, 3], "down": [3, 1], "color": "#ff0080", "numbers": [0, 0.5, 1],
            "name": "green"})",
        "f");
    SettingsReader reader(object, "f");
    glm::dvec2 range(0.0);
    glm::vec3 color(0.0f);
    reader.readRange("one", range, 0.0, 10.0);
    EXPECT_EQ(range, glm::dvec2(2.0, 2.0));
    reader.readRange("two", range, 0.0, 10.0);
    EXPECT_EQ(range, glm::dvec2(1.0, 3.0));
    EXPECT_THROW(reader.readRange("three", range, 0.0, 10.0), Error);
    EXPECT_THROW(reader.readRange("down", range, 0.0, 10.0), Error);
    glm::vec2 ends(0.0f);
    reader.readEnds("down", ends, 0.0, 10.0);
    EXPECT_EQ(ends, glm::vec2(3.0f, 1.0f));
    EXPECT_THROW(reader.readRange("one", range, 3.0, 10.0), Error);
    reader.readColor("color", color, 0.0, 1.0);
    EXPECT_EQ(color, glm::vec3(1.0f, 0.0f, 0.215861f));
    reader.readColor("numbers", color, 0.0, 1.0);
    EXPECT_EQ(color, glm::vec3(0.0f, 0.5f, 1.0f));
    EXPECT_THROW(reader.readColor("name", color, 0.0, 1.0), Error);
    EXPECT_THROW(reader.readColor("one", color, 0.0, 1.0), Error);
}

} // namespace
} // namespace sward
