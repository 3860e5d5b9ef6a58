#include "core/error.h"
#include "core/json/settings_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>

namespace sward {
namespace {

std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

TEST(SettingsReader, ReadsWhatIsThereAndLeavesTheRest)
{
    const auto object =
        parseJson(R"({"height": 2.5, "up": [0, 1, 0], "name": "x", "on": true})", "f");
    SettingsReader reader(object, "f");
    double height = 1.0;
    double width = 3.0;
    glm::vec3 up(9.0f);
    std::string name;
    bool on = false;
    reader.read("height", height, 0, 10);
    reader.read("width", width, 0, 10);
    reader.read("up", up, -1, 1);
    reader.read("name", name);
    reader.read("on", on);
    reader.finish();
    EXPECT_EQ(height, 2.5);
    EXPECT_EQ(width, 3.0);
    EXPECT_EQ(up, glm::vec3(0, 1, 0));
    EXPECT_EQ(name, "x");
    EXPECT_TRUE(on);
}

TEST(SettingsReader, ReadsAFormerNameWithAWarning)
{
    const nlohmann::json json = nlohmann::json::parse(R"({"most": 3})");
    SettingsReader reader(json, "file");
    float value = 1.0f;
    reader.readRenamed("max", "most", value, 0.0, 5.0);
    EXPECT_NO_THROW(reader.finish());
    EXPECT_EQ(value, 3.0f);
    ASSERT_EQ(reader.warnings().size(), 1u);
    EXPECT_NE(reader.warnings()[0].find("\"most\" is now called \"max\""), std::string::npos);

    // By its present name there is nothing to warn of.
    const nlohmann::json present = nlohmann::json::parse(R"({"max": 4})");
    SettingsReader other(present, "file");
    other.readRenamed("max", "most", value, 0.0, 5.0);
    EXPECT_EQ(value, 4.0f);
    EXPECT_TRUE(other.warnings().empty());

    // Bounds hold for either name, and a file with both is wrong.
    for (const char* text : {R"({"most": 6})", R"({"max": 6})", R"({"most": 1, "max": 1})"}) {
        const nlohmann::json wrong = nlohmann::json::parse(text);
        SettingsReader third(wrong, "file");
        EXPECT_THROW(third.readRenamed("max", "most", value, 0.0, 5.0), Error) << text;
    }
}

TEST(SettingsReader, ProposesTheNearestKeyForAnUnknownOne)
{
    const auto object = parseJson(R"({"heigth": 2})", "meadow.json");
    SettingsReader reader(object, "meadow.json");
    double height = 0.0;
    reader.read("height", height, 0, 10);
    const std::string message = messageOf([&] { reader.finish(); });
    EXPECT_NE(message.find("meadow.json"), std::string::npos);
    EXPECT_NE(message.find("\"heigth\""), std::string::npos);
    EXPECT_NE(message.find("\"height\""), std::string::npos);
}

TEST(SettingsReader, NamesPlaceValueAndBound)
{
    const auto object =
        parseJson(R"({"height": 12, "width": "wide", "n": 1.5, "up": [1, 2]})", "f");
    SettingsReader reader(object, "f");
    double number = 0.0;
    int whole = 0;
    glm::vec3 up(0.0f);
    const std::string message = messageOf([&] { reader.read("height", number, 0, 10); });
    EXPECT_NE(message.find("f: height"), std::string::npos);
    EXPECT_NE(message.find("12"), std::string::npos);
    EXPECT_NE(message.find("10"), std::string::npos);
    EXPECT_NE(messageOf([&] { reader.read("width", number, 0, 10); }), "");
    EXPECT_NE(messageOf([&] { reader.read("n", whole, 0, 10); }), "");
    EXPECT_NE(messageOf([&] { reader.read("up", up, 0, 10); }), "");
    EXPECT_NE(messageOf([&] { reader.child("missing"); }), "");
}

TEST(SettingsReader, RefusesTextThatIsNotJson)
{
    EXPECT_NE(messageOf([] { parseJson("{\"a\": }", "broken.json"); }).find("broken.json"),
              std::string::npos);
    const auto list = parseJson("[1]", "f");
    EXPECT_NE(messageOf([&] { SettingsReader(list, "f"); }), "");
}

TEST(ParseJson, CountsDepthAndValuesBeforeItMakesThem)
{
    // Characters inside strings and escaped quotes do not count.
    const std::string text = R"({"a": "[[[[,,,,{{{{\"[[[[", "b": ["\\", 1]})";
    EXPECT_EQ(parseJson(text, "f")["b"][1], 1);
    const std::string fits = std::string(jsonDepthLimit, '[') + std::string(jsonDepthLimit, ']');
    EXPECT_NO_THROW(parseJson(fits, "f"));
    EXPECT_NE(messageOf([&] { parseJson("[" + fits + "]", "f"); }).find("128 deep"),
              std::string::npos);
    EXPECT_NE(messageOf([&] {
                  std::string many = "[0";
                  for (std::size_t i = 0; i < jsonValueLimit; ++i)
                      many += ",0";
                  parseJson(many, "f");
              }).find("8000001 values"),
              std::string::npos);
}

TEST(NearestWord, FindsTyposAndNothingElse)
{
    EXPECT_EQ(nearestWord("densty", {"density", "count"}), "density");
    EXPECT_EQ(nearestWord("elephant", {"density", "count"}), "");
}

} // namespace
} // namespace sward
