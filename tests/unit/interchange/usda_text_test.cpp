#include "interchange/usda/usda_text.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace sward::interchange
