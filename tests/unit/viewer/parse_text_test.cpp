#include "apps/common/parse_text.h"
#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::apps {
namespace {

template <typename Parse>
void expectUsageError(const char* text, Parse parse)
{
    try {
        parse(text);
        ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
        EXPECT_THAT(error.what(), testing::HasSubstr("--option")) << text;
    }
}

TEST(ParseSize, TakesWidthAndHeightWithinTheBound)
{
    EXPECT_EQ(parseSize("--option", "1920x1080", 4096), glm::uvec2(1920, 1080));
    EXPECT_EQ(parseSize("--option", "1x4096", 4096), glm::uvec2(1, 4096));
    for (const char* text : {"", "x", "5", "5x", "x5", "0x5", "5x0", "4097x1", "-1x5", "5X5",
                             "5x5x5", "5x5 ", "99999999999x1"})
        expectUsageError(text, [](const char* wrong) { parseSize("--option", wrong, 4096); });
}

TEST(ParseNumber, TakesDecimalsAndFractionsWithinTheBounds)
{
    EXPECT_DOUBLE_EQ(parseNumber("--option", "0.25", 0.0, 1.0), 0.25);
    EXPECT_DOUBLE_EQ(parseNumber("--option", "1/60", 0.0, 1.0), 1.0 / 60.0);
    EXPECT_DOUBLE_EQ(parseNumber("--option", "1e-3", 0.0, 1.0), 1e-3);
    for (const char* text :
         {"", "a", "1.5", "-0.1", "nan", "inf", "1/0", "1/", "/2", "1 ", "1/2/3"})
        expectUsageError(text, [](const char* wrong) { parseNumber("--option", wrong, 0.0, 1.0); });
}

TEST(ParseBytes, TakesPowersOf1024WithinTheBounds)
{
    EXPECT_EQ(parseBytes("--option", "512M", 0, 1ull << 40), 512ull << 20);
    EXPECT_EQ(parseBytes("--option", "1.5G", 0, 1ull << 40), 3ull << 29);
    EXPECT_EQ(parseBytes("--option", "2K", 0, 1ull << 40), 2048u);
    EXPECT_EQ(parseBytes("--option", "1T", 0, 1ull << 40), 1ull << 40);
    EXPECT_EQ(parseBytes("--option", "77", 0, 1ull << 40), 77u);
    for (const char* text :
         {"", "M", "-1M", "1MB", "1 M", "M1", "nan", "infG", "1m", "2T", "0x5M", "3K", "1e30"})
        expectUsageError(
            text, [](const char* wrong) { parseBytes("--option", wrong, 4096, 1ull << 40); });
}

TEST(ParseRange, TakesTwoNumbersInOrder)
{
    EXPECT_EQ(parseRange("--option", "-5:10.5"), std::pair(-5.0, 10.5));
    EXPECT_EQ(parseRange("--option", "3:3"), std::pair(3.0, 3.0));
    for (const char* text : {"", ":", "1", "1:", ":1", "2:1", "1:2:3", "nan:1", "0:inf"})
        expectUsageError(text, [](const char* wrong) { parseRange("--option", wrong); });
}

TEST(ParseWholeRange, TakesTwoWholeNumbersWithinTheBound)
{
    const auto [first, last] = parseWholeRange("--option", "0:100", 100);
    EXPECT_EQ(first, 0u);
    EXPECT_EQ(last, 100u);
    for (const char* text : {"", "1", "0:101", "-1:5", "0.5:2", "7:3", "0:1:2"})
        expectUsageError(text, [](const char* wrong) { parseWholeRange("--option", wrong, 100); });
}

TEST(SplitText, JoinsToTheSameTextAgain)
{
    for (const std::string_view text : {"", ",", "a", "a,b", ",a,,b,"}) {
        std::string joined;
        for (const std::string_view part : splitText(text, ','))
            joined += (joined.empty() && part.data() == text.data() ? "" : ",") + std::string(part);
        EXPECT_EQ(joined, text);
    }
    EXPECT_EQ(splitText("a,,b", ',').size(), 3u);
}

} // namespace
} // namespace sward::apps
