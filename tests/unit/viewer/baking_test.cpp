#include "apps/common/terminal/progress_bar.h"
#include "apps/sward_view/fields/baking.h"
#include "apps/sward_view/fields/meadow_requests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::view {
namespace {

using testing::ElementsAre;

TEST(BakeProgress, ReadsWhatTheProgressBarWrites)
{
    for (const double share : {0.0, 0.07, 0.5, 1.0}) {
        const auto progress = parseProgress(apps::progressLine("sampling", share, 80));
        ASSERT_TRUE(progress.has_value());
        EXPECT_EQ(progress->state, "sampling");
        EXPECT_NEAR(progress->share, share, 0.006);
    }
}

TEST(BakeProgress, TakesNoOtherLineForABar)
{
    for (const char* line : {"", "error: a.glb: no triangles", "kept 5 of 7 roots", "50 %"})
        EXPECT_FALSE(parseProgress(line).has_value()) << line;
}

TEST(BakeArguments, NameOnlyWhatIsWanted)
{
    MeadowRequests requests;
    requests.ground = "hills";
    EXPECT_THAT(bakeArguments(requests), ElementsAre("hills", "--meadow", "meadow"));

    requests.meadow = 8; // steppe
    requests.amount = 2;
    requests.spacing = 0.25f;
    requests.slopeHigh = 40.0f;
    requests.masks = "vertex-color:R texture:a.png:G";
    requests.traits = " clump_size_m=1 ";
    EXPECT_THAT(bakeArguments(requests),
                ElementsAre("hills", "--meadow", "steppe", "--spacing", "0.25", "--slope", "0:40",
                            "--mask", "vertex-color:R", "--mask", "texture:a.png:G", "--set",
                            "clump_size_m=1"));
}

TEST(BakeArguments, NameAMeadowOfTheUsersOwnInsteadOfABuiltInOne)
{
    MeadowRequests requests;
    requests.ground = "hills";
    requests.meadow = 1;
    requests.meadowFile = "moor.json";
    EXPECT_THAT(bakeArguments(requests), ElementsAre("hills", "--meadow", "moor.json"));
}

TEST(RequestsOf, AFieldWithoutMasksNameNone)
{
    EXPECT_EQ(requestsOf(R"({"settings": {"masks": []}})").masks, "none");
    EXPECT_EQ(requestsOf(R"({"settings": {}})").masks, "");
}

TEST(RequestsOf, AFieldAreThoseItWasBakedWith)
{
    const MeadowRequests requests = requestsOf(
        R"({"settings": {"density": null, "count": 5000, "spacing": null, "seed": 7,
            "slope": [0.0, 50.0, 15.0], "masks": ["vertex-color:R", "texture:9f3a:G:invert"],
            "meadow": {"name": "steppe"}}})");
    EXPECT_THAT(bakeArguments(requests),
                ElementsAre("", "--meadow", "steppe", "--count", "5000", "--slope", "0:50~15",
                            "--seed", "7", "--mask", "vertex-color:R"));
}

TEST(RequestsOf, AFieldThatTellsNothingOrNonsenseAreNone)
{
    const auto none = bakeArguments(MeadowRequests());
    for (const char* text :
         {"", "{}", "[]", "7", R"({"settings": 3})", R"({"settings": {"masks": [1], "seed": "a"}})",
          R"({"settings": {"slope": [0, 50], "count": -1, "meadow": {"name": 3}}})"})
        EXPECT_EQ(bakeArguments(requestsOf(text)), none) << text;
}

TEST(WantsBaking, KnowsMeshesAndBuiltInGroundsFromFields)
{
    for (const char* input : {"a.glb", "A.OBJ", "b.r16", "c.exr", "recipe.json", "hills"})
        EXPECT_TRUE(wantsBaking(input)) << input;
    for (const char* input : {"a.sward", "meadow", "a.png.sward"})
        EXPECT_FALSE(wantsBaking(input)) << input;
}

} // namespace
} // namespace sward::view
