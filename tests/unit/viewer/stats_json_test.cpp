#include "apps/sward_view/headless/stats_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward::view {
namespace {

TEST(StatsText, SaysZeroOfAPassThatDidNotRun)
{
    RunStats stats;
    stats.gpuTimes["update"] = {.min = 1.0, .median = 2.0, .p99 = 3.0, .count = 3};
    const nlohmann::json json = nlohmann::json::parse(statsText(stats));
    EXPECT_EQ(json["gpu_ms"]["update"],
              nlohmann::json({{"min", 1.0}, {"median", 2.0}, {"p99", 3.0}}));
    EXPECT_EQ(json["gpu_ms"]["pyramid"],
              nlohmann::json({{"min", 0.0}, {"median", 0.0}, {"p99", 0.0}}));
    EXPECT_EQ(json["gpu_ms"].size(), 9u);
}

TEST(StatsText, SharesTheMemoryAmongTheBladesIfThereAreAny)
{
    RunStats stats;
    stats.deviceBytes = 4'000;
    EXPECT_EQ(nlohmann::json::parse(statsText(stats))["memory_bytes"]["per_blade"], 0.0);
    stats.blades.resident = 100;
    EXPECT_EQ(nlohmann::json::parse(statsText(stats))["memory_bytes"]["per_blade"], 40.0);
}

TEST(StatsText, SurvivesADeviceNameThatIsNotUtf8)
{
    RunStats stats;
    stats.device = "GPU \xff";
    EXPECT_TRUE(nlohmann::json::accept(statsText(stats)));
}

} // namespace
} // namespace sward::view
