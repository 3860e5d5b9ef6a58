#include "bake/settings/meadow.h"
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
        R"({"species": [{"cover": 0}]})",
        R"({"species": [{"slope": "30"}]})",
        R"({"species": [{"slope": 30}]})",
        R"({"species": [{"slope": [30, 0]}]})",
        R"({"species": [{"height_m": [1, 2], "share": 2, "height_m": [2, 3]}]})",
        R"({"species": [{"name": "clover"}, {"name": "rye"}, {"name": "clover"}]})",
        R"({"species": [{"tip_color": "green"}]})",
        R"({"species": [{"tip_color": 1}]})",
        R"({"species": [{"mask": "red"}]})",
        R"({"species": [{"mask": [1]}]})",
        R"({"species": [{"facing": "inward"}]})",
        R"({"species": [{"priority": 0.5}]})",
        R"({"species": [{}], "sparse_height": 2})",
        R"({"species": [{}], "height_waves": 0.6})",
        R"({"species": [{}], "drifts": -0.1})",
        R"({"species": [{}], "occluder_height": 0})",
        R"({"species": [{}], "occluder_dryness": 1.1})",
        R"({"species": [{}], "path_height": 1.5})",
        R"({"species": [{}], "path_reach_m": -1})",
        R"({"species": [{"tuft_lean": 2}]})",
        R"({"species": [{"tuft_litter": -0.1}]})",
    };
    for (const char* text : wrong)
        EXPECT_THROW(parseMeadow(text, "meadow.json"), Error) << text;
    EXPECT_NO_THROW(parseMeadow(R"({"species": [{}]})", "meadow.json"));
}

TEST(Meadow, TakesOneNumberForARangeAndColorsOfTheWeb)
{
    const char* const text = R"({"species": [
        {"name": "a", "height_m": 0.5, "stiffness": 0.25, "slope": [5, 30], "root_color": "#000000",
         "tip_color": "#80ff00", "organs": [{"length": 0.5, "tip_color": "#ffffff"}]},
        {"height_m": [0.25, 0.5]}, {"height_m": [0.5, 1]}]})";
    const Meadow meadow = parseMeadow(text, "meadow.json");
    const SpeciesTraits& one = meadow.species[0];
    EXPECT_EQ(one.height, glm::dvec2(0.5, 0.5));
    EXPECT_EQ(one.stiffness, glm::dvec2(0.25, 0.25));
    EXPECT_EQ(textOf(one.habitat.slope), "5:30");
    EXPECT_EQ(one.look.rootColor, glm::vec3(0.0f));
    EXPECT_EQ(one.look.tipColor, glm::vec3(0.215861f, 1.0f, 0.0f));
    EXPECT_EQ(one.organs[0].length, glm::vec2(0.5f));
    EXPECT_EQ(one.organs[0].look.tipColor, glm::vec3(1.0f));
}

TEST(Meadow, WritesEverythingThatItReads)
{
    const char* const text = R"({
        "name": "all", "clump_size_m": 0.3, "sparse_height": 0.5, "cover_from_above": 0.25,
        "fit_overhangs": false, "height_waves": 0.25, "drifts": 0.5, "occluder_reach_m": 0.7,
        "occluder_height": 2, "occluder_dryness": 0.75, "path_reach_m": 0.3, "path_height": 0.25,
        "path_lean": 0.125, "crease_blend": 0.375, "wide_variation": 0.625,
        "species": [{
            "name": "one", "share": 0.25, "priority": -2, "cover": 0.5, "slope": "5:40~2.5",
            "altitude": ":300", "curvature": "-0.1:", "mask": ["vertex-color:G:invert",
            "texture:splat.png:B"], "height_m": [0.1, 0.2], "width_m": [0.01, 0.02],
            "stiffness": [0.2, 0.3], "clumping": 0.75, "facing": "shared", "tuft_spacing_m": 0.4,
            "tuft_radius_m": 0.05, "tuft_lean": 0.5, "tuft_litter": 0.25}]})";
    const Meadow meadow = parseMeadow(text, "all.json");
    const SpeciesTraits& one = meadow.species[0];
    EXPECT_EQ(one.priority, -2);
    EXPECT_EQ(one.cover, 0.5);
    EXPECT_EQ(one.habitat.slope.high, 40.0);
    EXPECT_EQ(one.habitat.slope.soft, 2.5);
    EXPECT_EQ(one.habitat.altitude.low, -unbounded);
    EXPECT_EQ(one.habitat.altitude.high, 300.0);
    EXPECT_EQ(one.habitat.curvature.low, -0.1);
    ASSERT_EQ(one.habitat.masks.size(), 2U);
    EXPECT_TRUE(one.habitat.masks[0].invert);
    EXPECT_EQ(one.habitat.masks[1].file, "splat.png");
    EXPECT_EQ(one.habitat.masks[1].channel, 2);
    EXPECT_EQ(one.facing, Facing::shared);
    EXPECT_EQ(one.tuftSpacing, 0.4);
    EXPECT_FALSE(meadow.fitsOverhangs);
    EXPECT_EQ(meadow.sparseHeight, 0.5);
    EXPECT_EQ(meadow.heightWaves, 0.25);
    EXPECT_EQ(meadow.drifts, 0.5);
    EXPECT_EQ(meadow.edges.occluderReach, 0.7);
    EXPECT_EQ(meadow.edges.occluderHeight, 2.0);
    EXPECT_EQ(meadow.edges.occluderDryness, 0.75);
    EXPECT_EQ(meadow.edges.pathReach, 0.3);
    EXPECT_EQ(meadow.edges.pathHeight, 0.25);
    EXPECT_EQ(meadow.edges.pathLean, 0.125);
    EXPECT_EQ(meadow.edges.creaseBlend, 0.375);
    EXPECT_EQ(meadow.wideVariation, 0.625);
    EXPECT_EQ(one.tuftLean, 0.5);
    EXPECT_EQ(one.tuftLitter, 0.25);
    EXPECT_EQ(toJson(parseMeadow(toJson(meadow), "again")), toJson(meadow));
}

TEST(WithAssignments, GoesByNameNumberAndAll)
{
    Meadow meadow;
    meadow.species.resize(3);
    meadow.species[0].name = "a";
    meadow.species[2].name = "c";
    const Meadow changed =
        withAssignments(meadow, {"species.*.share=2", "species.c.share=3", "species.1.slope=0:30",
                                 "meadow.clump_size_m=0.125", "name=two words"});
    EXPECT_EQ(changed.species[0].share, 2.0);
    EXPECT_EQ(changed.species[2].share, 3.0);
    EXPECT_EQ(changed.species[1].habitat.slope.high, 30.0);
    EXPECT_EQ(changed.clumpSize, 0.125);
    EXPECT_EQ(changed.name, "two words");
    for (const char* wrong :
         {"", "share", "share=1", "species=[]", "species.a=1", "species.d.share=1",
          "species.3.share=1", "species.a.share=many", "species.a.share=-1", "species.a.b.c=1",
          "clump_size_m=\"wide\"", "=1"}) {
        try {
            withAssignments(meadow, {wrong});
            FAIL() << wrong;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage) << wrong;
            EXPECT_NE(std::string(error.what()).find(std::string("--set ") + wrong),
                      std::string::npos)
                << error.what();
        }
    }
}

} // namespace
} // namespace sward::bake
