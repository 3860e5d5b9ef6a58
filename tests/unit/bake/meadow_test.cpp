#include "bake/meadow.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace sward::bake {
namespace {

TEST(Meadow, BuiltInsAllReadAndWriteBack)
{
    ASSERT_FALSE(builtInMeadows().empty());
    for (const std::string& name : builtInMeadows()) {
        const Meadow meadow = loadMeadow(name);
        EXPECT_FALSE(meadow.species.empty()) << name;
        EXPECT_EQ(toJson(parseMeadow(toJson(meadow), "again")), toJson(meadow)) << name;
    }
}

TEST(Meadow, UnknownNamesListTheBuiltIns)
{
    try {
        loadMeadow("medow");
        FAIL() << "was found";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_NE(std::string(error.what()).find("meadow"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("lawn"), std::string::npos);
    }
}

TEST(Meadow, RefusesWhatCannotGrow)
{
    const char* const wrong[] = {
        "",
        "[]",
        "{}",
        R"({"species": []})",
        R"({"species": [{"height_m": [0.5, 0.2]}]})",
        R"({"species": [{"height_m": [-1, 2]}]})",
        R"({"species": [{"heigth_m": [1, 2]}]})",
        R"({"species": [{"stiffness": [0, 2]}]})",
        R"({"species": [{}, {}, {}, {}, {}, {}, {}, {}, {}]})",
        R"({"species": [{}], "clump_size": 1})",
    };
    for (const char* text : wrong)
        EXPECT_THROW(parseMeadow(text, "meadow.json"), Error) << text;
    EXPECT_NO_THROW(parseMeadow(R"({"species": [{}]})", "meadow.json"));
}

} // namespace
} // namespace sward::bake
