#include "apps/common/progress_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace sward::apps {
namespace {

TEST(ProgressLine, NeverFillsTheTerminalsLastColumn)
{
    for (int columns = 0; columns < 200; ++columns)
        EXPECT_LT(progressLine("a stage with a long name", 0.5, columns).size(),
                  static_cast<std::size_t>(std::max(columns, 1)));
}

TEST(ProgressLine, GrowsWithTheShareFromNothingToAll)
{
    const auto cells = [](double share) {
        const std::string line = progressLine("rays", share, 80);
        return std::count(line.begin(), line.end(), '#');
    };
    EXPECT_EQ(cells(0.0), 0);
    for (int i = 0; i < 100; ++i)
        EXPECT_LE(cells(i / 100.0), cells((i + 1) / 100.0));
    EXPECT_EQ(cells(1.0), 50);
    EXPECT_NE(progressLine("rays", 0.42, 80).find("42 %"), std::string::npos);
}

TEST(ProgressBar, ThatIsNotShownCostsNothing)
{
    ProgressBar bar(false);
    EXPECT_FALSE(bar.callback());
}

} // namespace
} // namespace sward::apps
