#include "bake/plan.h"
#include "core/error.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

namespace sward::bake {
namespace {

BakeSettings undecided()
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.bladeScale.reset();
    return settings;
}

TEST(Plan, SowsThreeHundredOnASquareMetreOfFullSizeGround)
{
    Diagnostics diagnostics;
    const Plan plan = planBake(1600.0, 100.0, undecided(), diagnostics);
    EXPECT_EQ(plan.scale, 1.0);
    EXPECT_EQ(plan.density, 300.0);
    EXPECT_EQ(plan.expected, 480'000.0);
    EXPECT_TRUE(diagnostics.warnings().empty());
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

TEST(Plan, ClampsToTwentyMillionAndSaysWhatItWouldCost)
{
    Diagnostics diagnostics;
    const Plan plan = planBake(1e9, 100.0, undecided(), diagnostics);
    EXPECT_NEAR(plan.expected, 20e6, 1.0);
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_NE(diagnostics.warnings()[0].find("3e+11"), std::string::npos)
        << diagnostics.warnings()[0];
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
