#include "core/diagnostics.h"
#include "core/error.h"
#include "core/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sward {
namespace {

TEST(Progress, ReportsAtMostOncePerCent)
{
    std::vector<double> shares;
    Progress progress([&](const std::string&, double share) { shares.push_back(share); });
    progress.begin("stage", 100'000);
    for (int i = 0; i < 100'000; ++i)
        progress.advance(1);
    EXPECT_LE(shares.size(), 102U);
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
}

TEST(Progress, StopsTheWorkOnceCancelled)
{
    Progress progress;
    progress.begin("stage", 10);
    progress.cancel();
    try {
        progress.advance(1);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.exitCode(), 130);
    }
}

TEST(Diagnostics, EndWhereNobodyReadsOn)
{
    Diagnostics diagnostics;
    for (int i = 0; i < 100'000; ++i)
        diagnostics.warn("{} is odd", i);
    ASSERT_EQ(diagnostics.warnings().size(), Diagnostics::warningLimit + 1);
    EXPECT_EQ(diagnostics.warnings()[Diagnostics::warningLimit - 1], "999 is odd");
    EXPECT_EQ(diagnostics.warnings().back(), "further warnings are left out");
}

TEST(Diagnostics, SayEachThingOnce)
{
    Diagnostics diagnostics;
    diagnostics.warn("node {} has no mesh", 3);
    diagnostics.warn("node {} has no mesh", 4);
    diagnostics.warn("node {} has no mesh", 3);
    EXPECT_EQ(diagnostics.warnings().size(), 2U);
}

} // namespace
} // namespace sward
