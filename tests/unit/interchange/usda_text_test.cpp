#include "core/random.h"
#include "interchange/usda/usda_compact.h"
#include "interchange/usda/usda_text.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::interchange {
namespace {

TEST(UsdaText, StringsStayInTheirQuotationMarks)
{
    EXPECT_EQ(usdString("grass"), "\"grass\"");
    EXPECT_EQ(usdString("a \"b\" \\ c"), "\"a \\\"b\\\" \\\\ c\"");
    EXPECT_EQ(usdString("one\ntwo\t"), "\"one\\ntwo\\x09\"");
    EXPECT_EQ(usdString("© Gräser"), "\"© Gräser\"");
    EXPECT_EQ(usdString(""), "\"\"");
}

TEST(UsdaText, IdentifiersHaveLettersDigitsAndUnderscores)
{
    EXPECT_EQ(usdIdentifier("ryegrass"), "ryegrass");
    EXPECT_EQ(usdIdentifier("tall fescue-2"), "tall_fescue_2");
    EXPECT_EQ(usdIdentifier("2nd"), "_nd");
    EXPECT_EQ(usdIdentifier("</x>\n{"), "__x___");
    EXPECT_EQ(usdIdentifier(""), "_");
}

TEST(UsdaText, HundredthsOfAQuaternionTurnAndScaleLittle)
{
    double largestTurn = 0.0;
    double largestStretch = 0.0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const auto random = [&](std::uint32_t dimension) {
            return 2.0f * static_cast<float>(uniform(7, i, dimension)) - 1.0f;
        };
        const glm::quat exact =
            glm::normalize(glm::quat(random(0), random(1), random(2), random(3)));
        const std::array<int, 4> found = hundredthsOf(exact);
        const glm::dvec4 steps(found[0], found[1], found[2], found[3]);
        const double length = glm::length(steps) / 100.0;
        const glm::dvec4 real(exact.w, exact.x, exact.y, exact.z);
        const double cosine = std::abs(glm::dot(glm::normalize(steps), real));
        largestTurn = std::max(largestTurn, 2.0 * std::acos(std::min(1.0, cosine)));
        largestStretch = std::max(largestStretch, std::abs(length - 1.0));
    }
    EXPECT_LE(largestTurn, glm::radians(1.3));
    EXPECT_GT(largestTurn, glm::radians(0.6));
    EXPECT_LE(largestStretch, 0.0051);
}

} // namespace
} // namespace sward::interchange
