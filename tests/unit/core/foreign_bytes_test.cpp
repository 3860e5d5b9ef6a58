#include "core/error.h"
#include "core/foreign_bytes.h"
#include "core/log.h"
#include "core/settings_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward {
namespace {

TEST(ForeignBytes, AMarkIsSkippedOnceAtTheBeginning)
{
    EXPECT_EQ(withoutMark("\xef\xbb\xbf{}"), "{}");
    EXPECT_EQ(withoutMark("{\xef\xbb\xbf}"), "{\xef\xbb\xbf}");
    EXPECT_EQ(parseJson("\xef\xbb\xbf[1]", "a"), parseJson("[1]", "a"));
}

TEST(ForeignBytes, AnyTextIsPrintable)
{
    EXPECT_EQ(log::printable("grün — \"a b\"\n\tc"), "grün — \"a b\"\n\tc");
    for (int byte = 0; byte < 256; ++byte) {
        const std::string plain = log::printable(std::string("a") + static_cast<char>(byte) + "b");
        for (const char c : plain) {
            const auto own = static_cast<unsigned char>(c);
            EXPECT_TRUE((own >= 0x20 && own != 0x7f) || c == '\n' || c == '\t') << byte;
        }
    }
    EXPECT_EQ(log::printable("\x1b[2J"), "\\x1b[2J");
    EXPECT_EQ(log::printable("\xc2\x9b"
                             "2J"),
              "\\x9b2J");
}

TEST(ForeignBytes, LongWordsLoseTheirMiddleAndNoCharacterIsCut)
{
    std::string word;
    for (int i = 0; i < 1000; ++i)
        word += "ü";
    for (const char* before : {"", "a", "ab"}) {
        const std::string shown = log::printable(before + word + " end");
        EXPECT_LT(shown.size(), 300U);
        EXPECT_NO_THROW(static_cast<void>(nlohmann::json(shown).dump()));
        EXPECT_EQ(shown.substr(shown.size() - 4), " end");
    }
}

} // namespace
} // namespace sward
