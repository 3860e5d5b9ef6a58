#include "bake/plan/plan.h"
#include "bake/plan/sward_cover.h"
#include "core/error.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace sward::bake {
namespace {

BakeSettings undecided()
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.bladeScale.reset();
    return settings;
}

TEST(Plan, ClosesTheSwardOfFullSizeGround)
{
    Diagnostics diagnostics;
    const BakeSettings settings = undecided();
    const Plan plan = planBake(1600.0, 100.0, settings, diagnostics);
    EXPECT_EQ(plan.scale, 1.0);
    // Blades of independent places hide 1 − exp(−n · plan) of the ground.
    const double hidden = 1.0 - std::exp(-plan.density * coverOf(settings.meadow).plan);
    EXPECT_NEAR(hidden, settings.meadow.closedCover, 1e-3);
    EXPECT_EQ(plan.expected, 1600.0 * plan.density);
    EXPECT_EQ(plan.widening, 1.0);
    EXPECT_EQ(plan.thinned, 1.0);
    EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Plan, NarrowerBladesCloseASwardByMoreOfThem)
{
    BakeSettings settings = undecided();
    const double wide = closedDensity(settings.meadow);
    for (SpeciesTraits& species : settings.meadow.species)
        species.width *= 0.5;
    EXPECT_NEAR(closedDensity(settings.meadow), 2.0 * wide, 2.0);
    for (SpeciesTraits& species : settings.meadow.species)
        species.height *= 2.0;
    EXPECT_NEAR(closedDensity(settings.meadow), wide, 1.0);
}

TEST(Plan, BuiltInMeadowsStateTheirCover)
{
    // Leaf area index of the closed sward; a blade's plan is smaller than its area.
    const std::map<std::string, std::pair<double, double>> index{
        {"meadow", {3.0, 8.0}},  {"grass", {3.0, 8.0}},  {"hay", {3.0, 8.0}},
        {"dunes", {0.5, 4.0}},   {"lawn", {2.0, 6.0}},   {"steppe", {1.0, 5.0}},
        {"daisies", {2.5, 8.0}}, {"alpine", {1.5, 7.0}}, {"marsh", {2.0, 9.0}},
        {"prairie", {1.5, 8.0}}};
    for (const auto& [name, range] : index) {
        const Meadow meadow = loadMeadow(name);
        const BladeCover one = coverOf(meadow);
        const double leafAreaIndex = closedDensity(meadow) * one.leafArea;
        EXPECT_GT(leafAreaIndex, range.first) << name;
        EXPECT_LT(leafAreaIndex, range.second) << name;
        EXPECT_LT(one.plan, one.leafArea) << name;
    }
}

TEST(Plan, SowsSmallGroundAsThicklyForItsSize)
{
    // A copy a thousand times smaller bears as many blades, a thousand times smaller.
    Diagnostics diagnostics;
    const Plan large = planBake(400.0, 100.0, undecided(), diagnostics);
    const Plan small = planBake(400.0e-6, 100.0, undecided(), diagnostics);
    EXPECT_NEAR(small.scale, 0.001, 1e-9);
    EXPECT_NEAR(small.expected, large.expected, 1.0);
}

TEST(Plan, ABudgetKeepsTheLeafAreaThatItCanAndTellsTheRest)
{
    BakeSettings settings = undecided();
    const double whole = 1e4 * closedDensity(settings.meadow);
    for (const double share : {0.9, 0.5, 0.2, 0.01}) {
        Diagnostics diagnostics;
        settings.budget = static_cast<std::uint64_t>(share * whole);
        const Plan plan = planBake(1e4, 100.0, settings, diagnostics);
        EXPECT_NEAR(plan.expected, share * whole, 1.0);
        // Number, width and what the ground shows make the whole sward.
        EXPECT_NEAR(plan.expected * plan.widening * plan.thinned, whole, 1e-3 * whole);
        EXPECT_GE(plan.thinned, 1.0);
        EXPECT_LE(plan.widening, 2.0);
        ASSERT_EQ(diagnostics.warnings().size(), 1U);
        EXPECT_NE(diagnostics.warnings()[0].find("--budget"), std::string::npos);
    }
    // Ribbons of plants count as blades.
    {
        Diagnostics diagnostics;
        BakeSettings plants = settings;
        plants.meadow = loadMeadow("prairie");
        plants.budget = 10'000;
        const double perRoot = bladesPerRoot(plants.meadow);
        EXPECT_GT(perRoot, 1.5);
        EXPECT_NEAR(planBake(1e4, 100.0, plants, diagnostics).expected * perRoot, 1e4, 1.0);
        EXPECT_EQ(bladesPerRoot(loadMeadow("grass")), 1.0);
    }
    // The lower of two limits is the one that the warning names.
    {
        Diagnostics diagnostics;
        settings.budget = 3'000;
        settings.maxBlades = 2'000;
        EXPECT_EQ(planBake(1e4, 100.0, settings, diagnostics).expected, 2e3);
        EXPECT_NE(diagnostics.warnings()[0].find("--max-blades 2000 "), std::string::npos);
        settings.maxBlades = BakeSettings{}.maxBlades;
    }
    // The budget says nothing of a density or a count.
    Diagnostics diagnostics;
    settings.budget = 1;
    settings.density = 100.0;
    EXPECT_EQ(planBake(1e4, 100.0, settings, diagnostics).expected, 1e6);
    EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Plan, RefusesMoreThanTheMaximumBeforeSampling)
{
    Diagnostics diagnostics;
    BakeSettings settings = undecided();
    settings.density = 1000.0;
    settings.maxBlades = 999;
    try {
        planBake(1.0, 100.0, settings, diagnostics);
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("999"), std::string::npos);
    }
    settings.maxBlades = 1000;
    EXPECT_NO_THROW(planBake(1.0, 100.0, settings, diagnostics));
}

} // namespace
} // namespace sward::bake
