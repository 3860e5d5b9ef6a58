#include "apps/common/temporary_folder.h"
#include "apps/sward_view/fields/meadow_requests.h"
#include "apps/sward_view/fields/meadow_species.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace sward::view {
namespace {

using nlohmann::json;

TEST(MeadowSpecies, EveryPresetHasSpeciesWithColours)
{
    for (std::size_t i = 0; i < std::size(meadowPresets); ++i) {
        const auto species = speciesOf(textOfPreset(i), meadowPresets[i].name);
        EXPECT_EQ(species.size(), json::parse(textOfPreset(i))["species"].size());
        for (const MeadowSpecies& one : species) {
            EXPECT_GT(one.share, 0.0f) << one.name;
            EXPECT_LT(one.height.x, one.height.y) << one.name;
            EXPECT_GT(one.tip.x + one.tip.y + one.tip.z, 0.0f) << one.name;
        }
    }
    // A daisy's rays are white, its leaves are green.
    MeadowRequests requests;
    MeadowEditor editor(requests);
    ASSERT_TRUE(editor.species.back().flower.has_value());
    EXPECT_GT(editor.species.back().flower->z, 0.7f);
    EXPECT_FALSE(editor.species.front().flower.has_value());
}

TEST(MeadowSpecies, TextsThatAreNoMeadowAreRefused)
{
    for (const char* text :
         {"", "[]", "{}", "{\"species\": []}", "{\"species\": [1]}", "{\"species\": 3}"})
        EXPECT_THROW(speciesOf(text, "bad.json"), Error) << text;
    MeadowRequests requests;
    requests.meadowFile = "/nowhere/meadow.json";
    EXPECT_THROW(MeadowEditor{requests}, Error);
    // Wrong kinds of values keep their defaults, as the baker refuses them.
    EXPECT_EQ(
        speciesOf("{\"species\": [{\"share\": \"x\", \"height_m\": [1], \"tip_color\": 3}]}", "a"),
        std::vector{MeadowSpecies{}});
}

TEST(MeadowEditor, RefusesAFileThatIsTooLargeForAMeadow)
{
    const apps::TemporaryFolder folder{"sward-view"};
    MeadowRequests requests;
    requests.meadowFile = (folder.path() / "large.json").string();
    std::ofstream(requests.meadowFile) << "{}";
    std::filesystem::resize_file(requests.meadowFile, (std::uintmax_t(16) << 20) + 1);
    try {
        const MeadowEditor editor(requests);
        FAIL() << "it was read";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("large.json"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("16777216"), std::string::npos) << error.what();
    }
}

TEST(MeadowEditor, WritesWhatHasChangedAndKeepsAllElse)
{
    const apps::TemporaryFolder folder{"sward-view"};
    MeadowRequests requests;
    MeadowEditor editor(requests);
    EXPECT_FALSE(editor.isChanged());
    EXPECT_EQ(json::parse(editor.text()), json::parse(textOfPreset(0)));
    editor.species[1].tip = {0.5f, 0.25f, 0.125f};
    editor.species[1].share = 0.5f;
    EXPECT_TRUE(editor.isChanged());
    json expected = json::parse(textOfPreset(0));
    expected["species"][1]["tip_color"] = {0.5, 0.25, 0.125};
    expected["species"][1]["share"] = 0.5;
    EXPECT_EQ(json::parse(editor.text()), expected);

    const std::string path = (folder.path() / "mine.json").string();
    editor.save(path, false, requests);
    EXPECT_EQ(requests.meadowFile, path);
    EXPECT_TRUE(editor.isOf(requests));
    EXPECT_FALSE(editor.isChanged());
    EXPECT_EQ(json::parse(std::ifstream(path)), expected);
    EXPECT_EQ(MeadowEditor(requests).species, editor.species);
    // It goes on with its own file, and replaces no other.
    EXPECT_EQ(editor.file(), path);
    EXPECT_NE(MeadowEditor(requests).file(), path);
    EXPECT_THROW(editor.save(path, false, requests), Error);
    requests.meadowFile.clear();
    EXPECT_FALSE(editor.isOf(requests));
}

} // namespace
} // namespace sward::view
