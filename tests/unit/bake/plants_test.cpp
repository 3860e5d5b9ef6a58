// Compound plants, from a meadow to the field.
#include "bake/bake.h"
#include "bake/settings/meadow.h"
#include "core/error.h"
#include "field/verify.h"
#include "shaders/shared/visibility.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace sward::bake {
namespace {

// A third of the roots are plants of 17 ribbons.
BakeSettings plantSettings(double density)
{
    BakeSettings settings = tests::plainSettings(density);
    SpeciesTraits plant = settings.meadow.species[0];
    plant.name = "plant";
    plant.share = 0.5;
    field::Organ leaf;
    leaf.count = 5;
    leaf.place = {0.0f, 0.4f};
    leaf.length = {0.5f, 1.0f};
    field::Organ petal;
    petal.count = 12;
    petal.length = {0.05f, 0.05f};
    plant.organs = {leaf, petal};
    settings.meadow.species.push_back(plant);
    return settings;
}

field::Field grow(const terrain::GroundMesh& mesh, const BakeSettings& settings, int threads)
{
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(mesh, settings, threads, diagnostics, progress).field;
}

TEST(Plants, StayTogetherInPatchesOfAllSizes)
{
    for (const double density : {3.0, 40.0, 700.0}) {
        const field::Field field = grow(meshes::square(9.0), plantSettings(density), 2);
        // Verifies that ribbons follow their stalks, and the size of patches.
        field::verify(field::viewOf(field), "plants");
        std::size_t stalks = 0;
        std::size_t ribbons = 0;
        const field::FieldView view = field::viewOf(field);
        for (std::size_t b = 0; b < view.blades.size(); ++b) {
            ribbons += view.isRibbon(b) ? 1U : 0U;
            stalks += (view.blades[b].look >> 21U & 7U) == 1 && !view.isRibbon(b) ? 1U : 0U;
        }
        EXPECT_GT(stalks, 20U);
        EXPECT_EQ(ribbons, 17 * stalks);
    }
}

TEST(Plants, AreTheSameBytesForAnyNumberOfThreads)
{
    const terrain::GroundMesh mesh = meshes::sphere();
    const field::Field one = grow(mesh, plantSettings(300.0), 1);
    const field::Field more = grow(mesh, plantSettings(300.0), 4);
    ASSERT_EQ(one.blades.size(), more.blades.size());
    for (std::size_t b = 0; b < one.blades.size(); ++b) {
        ASSERT_EQ(one.blades[b].shape, more.blades[b].shape);
        ASSERT_EQ(one.blades[b].look, more.blades[b].look);
    }
}

TEST(Plants, ARibbonLiesInTheBoundsOfItsPatchInAnyPose)
{
    const field::Field field = grow(meshes::square(6.0), plantSettings(60.0), 2);
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const shared::Species& look = field.species[blade.species].look;
            for (const float side : {-0.9f, 0.0f, 0.9f}) {
                const shared::BladeState state = shared::stateOfTurn({side, 0.3f}, 0.0f);
                shared::PosedBlade posed = shared::posedBlade(blade, state);
                if (const std::uint32_t number = shared::ribbonNumber(look, blade); number > 0)
                    posed = shared::ribbonOf(field::viewOf(organs), look, posed, number);
                for (const glm::vec3& place : {posed.v0, posed.v2})
                    for (glm::length_t axis = 0; axis < 3; ++axis) {
                        ASSERT_GE(place[axis], patch.boundsLow[axis]);
                        ASSERT_LE(place[axis], patch.boundsHigh[axis]);
                    }
            }
        }
}

// Level of detail draws the plants whose stalk's rank is below a share, with all of their ribbons.
TEST(Plants, ThinningKeepsTheirShare)
{
    const field::Field field = grow(meshes::square(30.0), plantSettings(60.0), 2);
    const field::FieldView view = field::viewOf(field);
    const auto shareOfPlants = [&](float below) {
        double plants = 0.0;
        double roots = 0.0;
        for (const shared::Patch& patch : view.patches)
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
                const std::size_t b = patch.firstBlade + i;
                if (view.isRibbon(b) || shared::bladeRank(patch, i) >= below)
                    continue;
                roots += 1.0;
                plants += (view.blades[b].look >> 21U & 7U) == 1 ? 1.0 : 0.0;
            }
        return plants / roots;
    };
    const double whole = shareOfPlants(1.0f);
    EXPECT_NEAR(whole, 1.0 / 3.0, 0.02);
    for (const float share : {0.05f, 0.2f, 0.5f})
        EXPECT_NEAR(shareOfPlants(share) / whole, 1.0, 0.07) << share;
}

TEST(Plants, StandAloneInClumpsOfGrass)
{
    BakeSettings settings = plantSettings(400.0);
    settings.meadow.clumpSize = 1.0;
    settings.meadow.species[0].clumping = 1.0;
    settings.meadow.species[1].share = 0.05;
    const field::Field field = grow(meshes::square(10.0), settings, 2);
    const field::FieldView view = field::viewOf(field);
    // Plants by square metre.
    std::array<std::array<int, 10>, 10> counts{};
    double plants = 0.0;
    double roots = 0.0;
    glm::vec3 low(1e9f);
    for (const shared::Patch& patch : view.patches)
        if (patch.bladeCount > 0)
            low = glm::min(low, patch.rootLow);
    for (const shared::Patch& patch : view.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const std::size_t b = patch.firstBlade + i;
            if (view.isRibbon(b))
                continue;
            roots += 1.0;
            if ((view.blades[b].look >> 21U & 7U) != 1)
                continue;
            plants += 1.0;
            const glm::vec3 at = shared::unpackBlade(view.blades[b], patch).root - low;
            ++counts[std::min<std::size_t>(static_cast<std::size_t>(at.x), 9)]
                    [std::min<std::size_t>(static_cast<std::size_t>(at.z), 9)];
        }
    // The share holds, and no square has many times its part.
    EXPECT_NEAR(plants / roots, 0.05 / 1.05, 0.005);
    for (const auto& row : counts)
        for (const int count : row)
            EXPECT_LT(count, 3.0 * plants / 100.0);
}

TEST(Plants, AreReadFromAMeadowAndWrittenAgain)
{
    const char* text = R"({"species": [{"name": "daisy", "organs": [
        {"name": "petal", "count": 13, "place": [1, 1], "pitch_deg": [80, 85], "length": [0.1, 0.12],
         "width": 0.3, "turn_deg": 137.5, "bend_deg": -10, "tip_color": [0.9, 0.9, 0.9]}]}]})";
    const Meadow meadow = parseMeadow(text, "test");
    ASSERT_EQ(meadow.species[0].organs.size(), 1U);
    EXPECT_EQ(meadow.species[0].organs[0].count, 13U);
    const Meadow again = parseMeadow(toJson(meadow), "again");
    EXPECT_TRUE(field::areAlike(meadow.species[0].organs[0], again.species[0].organs[0]));
    EXPECT_EQ(toJson(meadow), toJson(again));

    const auto kindOf = [](const char* organs) {
        try {
            parseMeadow(std::string(R"({"species": [{"organs": )") + organs + "}]}", "test");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_EQ(kindOf("[]"), "none");
    for (const char* wrong : {R"([{"count": 64}])", R"([{"count": 0}])", R"([{"length": [0, 1]}])",
                              R"([{"leng": [0.1, 0.1]}])", R"([{"shape": "disk"}])", "{}",
                              R"([{"count": 40}, {"count": 40}])"})
        EXPECT_NE(kindOf(wrong).find("organs"), std::string::npos) << wrong;
}

} // namespace
} // namespace sward::bake
