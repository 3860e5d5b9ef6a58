#include "core/error.h"
#include "core/json/json_text.h"
#include "core/random.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward {
namespace {

using nlohmann::json;

std::string anyBytes(std::uint32_t seed)
{
    std::string bytes;
    for (std::uint32_t i = 0; i < seed % 12; ++i)
        bytes += static_cast<char>(hashBits(seed, i) & 0xff);
    return bytes;
}

TEST(JsonText, SurvivesAnyBytes)
{
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const std::string bytes = anyBytes(seed);
        const json object = {{bytes, bytes}};
        EXPECT_TRUE(json::accept(jsonText(object)));
        EXPECT_TRUE(isUtf8(toUtf8(bytes)));
        EXPECT_EQ(toUtf8(bytes) == bytes, isUtf8(bytes));
        EXPECT_TRUE(json::accept(jsonText(nlohmann::ordered_json(object), 2)));
    }
    EXPECT_EQ(jsonText(json("caf\xe9.obj")), "\"caf\xef\xbf\xbd.obj\"");
    EXPECT_EQ(jsonText(json("café.obj")), "\"café.obj\"");
}

TEST(JsonText, KeepsBytesThatMustBeFoundAgain)
{
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const std::string bytes = anyBytes(seed);
        const json kept = json::parse(jsonText(bytesToJson(bytes)));
        EXPECT_EQ(bytesFromJson(kept, "a"), bytes);
    }
    EXPECT_EQ(bytesToJson("50%é"), "50%é");
    EXPECT_EQ(bytesToJson("50% \xe9"), json({{"percent", "50%25%20%E9"}}));
}

TEST(JsonText, RefusesWhatStandsForNoBytes)
{
    for (const char* text :
         {"1", "null", "[]", "{}", R"({"percent": 1})", R"({"percent": "%"})",
          R"({"percent": "%4"})", R"({"percent": "%4g"})", R"({"percent": "a", "more": 1})"}) {
        try {
            static_cast<void>(bytesFromJson(json::parse(text), "plan: folder"));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << text;
            EXPECT_NE(std::string(error.what()).find("plan: folder"), std::string::npos) << text;
        }
    }
}

} // namespace
} // namespace sward
