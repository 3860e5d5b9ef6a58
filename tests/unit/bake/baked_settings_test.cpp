#include "bake/settings/baked_settings.h"
#include "core/error.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

std::string provenanceOf(const BakeSettings& settings)
{
    return R"({"tool": "sward 0.1.0", "settings": )" + toJson(settings) + "}";
}

// Settings none of which is the default.
BakeSettings unusual()
{
    BakeSettings settings = tests::plainSettings(12.25);
    settings.bladeScale = 0.1 + 0.2;
    settings.seed = 0xfedcba9876543210;
    settings.sides = Sides::both;
    settings.align.vertical = 1.0 / 3.0;
    settings.groundUp.direction = {0.0, 0.0, -1.0};
    settings.slope = {1.0, 44.5, 3.25};
    settings.altitude = {-100.0, 1e4, 7.0};
    settings.curvature.high = 0.7;
    settings.border.low = 2.0;
    settings.water = {0.4, 90.0, 0.1};
    settings.sky = {0.25, 1.0, 0.5};
    settings.minIsland = 3.5;
    settings.clearance = 0.4;
    settings.exposureRays = 3;
    settings.rayLength = 12.0;
    settings.masks = {parseMask("vertex-color2:G:invert"), parseMask("ground:green")};
    settings.meadow = withAssignments(loadMeadow("alpine"), {"height_waves=0.3"});
    return settings;
}

TEST(BakedSettings, AreThoseOfTheBake)
{
    const std::vector<std::function<void(BakeSettings&)>> changes{
        [](BakeSettings&) {},
        [](BakeSettings& settings) {
            settings.density.reset();
            settings.budget = 12'345;
            settings.bladeScale.reset();
        },
        [](BakeSettings& settings) {
            settings.density.reset();
            settings.count = 4'000'000'000;
            settings.groundUp = {.radial = true, .centre = {1.0, -2e6, 0.3}};
        },
        [](BakeSettings& settings) {
            settings.density.reset();
            settings.spacing = 0.07;
            settings.spread = Spread::poissonDense;
            settings.sides = Sides::back;
        }};
    for (const auto& change : changes) {
        BakeSettings settings = unusual();
        change(settings);
        BakeSettings given;
        given.seed = 77;
        given.spread = Spread::poisson;
        const BakeSettings read = bakedSettings(provenanceOf(settings), given, "a.sward");
        EXPECT_EQ(toJson(read), toJson(settings));
        EXPECT_EQ(read.maxBlades, given.maxBlades);
    }
}

TEST(BakedSettings, NameWhatAFieldDoesNotHold)
{
    const auto expectRefused = [](const std::string& provenance, const std::string& why) {
        try {
            bakedSettings(provenance, {}, "a.sward");
            ADD_FAILURE() << "read: " << provenance.substr(0, 80);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("a.sward"), std::string::npos);
        }
    };
    BakeSettings settings = unusual();
    settings.masks = {parseMask("texture:m.png:R")};
    expectRefused(provenanceOf(settings), "--mask");
    BakeSettings given;
    given.masks = settings.masks;
    EXPECT_EQ(bakedSettings(provenanceOf(settings), given, "a.sward").masks.size(), 1U);
    settings = unusual();
    settings.excluded = {parseExcludedArea("pond.glb:1")};
    expectRefused(provenanceOf(settings), "--exclude");
    settings = unusual();
    settings.strokes = tests::allKinds();
    expectRefused(provenanceOf(settings), "--paint");
    settings = unusual();
    settings.meadow.species[0].habitat.masks = {parseMask("texture:m.png:R")};
    expectRefused(provenanceOf(settings), "--meadow");
    given.meadow = settings.meadow;
    EXPECT_EQ(toJson(bakedSettings(provenanceOf(settings), given, "a.sward").meadow),
              toJson(settings.meadow));

    expectRefused("", "JSON");
    expectRefused("[]", "settings");
    expectRefused("{}", "settings");
    expectRefused(R"({"settings": 3})", "settings");
    expectRefused(R"({"settings": {"count": -1}})", "count");
    expectRefused(R"({"settings": {"density": "x"}})", "density");
    expectRefused(R"({"settings": {"slope": [0, 1]}})", "slope");
    expectRefused(R"({"settings": {"slope": [2, 1, 0]}})", "slope");
    expectRefused(R"({"settings": {"sky": [0, 1, -1]}})", "sky");
    expectRefused(R"({"settings": {"ground_up": [0, 0, 0]}})", "ground_up");
    expectRefused(R"({"settings": {"sampling": "even"}})", "sampling");
    expectRefused(R"({"settings": {"sides": 3}})", "sides");
    expectRefused(R"({"settings": {"masks": [7]}})", "masks");
    expectRefused(R"({"settings": {"masks": 7}})", "masks");
    expectRefused(R"({"settings": {"meadow": 7}})", "meadow");
    expectRefused(R"({"settings": {"wind": 7}})", "wind");
}

} // namespace
} // namespace sward::bake
