#include "apps/common/terminal/progress_bar.h"
#include "core/log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>

namespace sward::apps {
namespace {

TEST(ProgressLine, NeverFillsTheTerminalsLastColumn)
{
    for (int columns = 0; columns < 200; ++columns)
        EXPECT_LT(progressLine("a state with a long name", 0.5, columns).size(),
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

TEST(ProgressBar, MessagesOfOtherThreadsStandOnLinesOfTheirOwn)
{
    constexpr int messages = 200;
    testing::internal::CaptureStderr();
    {
        ProgressBar bar(true);
        const Progress::Callback show = bar.callback();
        std::thread other([] {
            for (int i = 0; i < messages; ++i)
                log::warn("message {}", i);
        });
        for (int i = 0; i <= 1000; ++i)
            show("sample", i / 1000.0);
        other.join();
    }
    const std::string text = testing::internal::GetCapturedStderr();

    // Each message begins where a line begins: behind another one or behind the erased bar.
    const std::string erased = "\r\033[K";
    int found = 0;
    for (std::size_t at = text.find("warning: "); at != std::string::npos;
         at = text.find("warning: ", at + 1), ++found)
        EXPECT_TRUE(at == 0 || text[at - 1] == '\n' || text.substr(0, at).ends_with(erased))
            << text.substr(at > 20 ? at - 20 : 0, 60);
    EXPECT_EQ(found, messages);
    EXPECT_TRUE(text.ends_with(erased)) << "the bar is taken away";
}

} // namespace
} // namespace sward::apps
