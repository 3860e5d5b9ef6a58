#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "core/log.h"
#include "core/plain_text.h"

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

TEST(ForeignBytes, NoByteCutsTheMessageOfAnErrorNorSteersATerminal)
{
    for (int byte = 0; byte < 256; ++byte) {
        const std::string said = std::string("file ") + static_cast<char>(byte) + " end";
        try {
            fail(ErrorKind::input, "{}", said);
        } catch (const Error& error) {
            const std::string what = error.what();
            EXPECT_EQ(what.substr(what.size() - 4), " end") << byte;
            EXPECT_EQ(what.find_first_of(std::string("\0\a\x1b\x7f\r", 5)), std::string::npos)
                << byte;
        }
    }
    EXPECT_EQ(std::string(Error(ErrorKind::input, std::string("a\0b", 3)).what()), "a\\x00b");
}

TEST(ForeignBytes, JsonHasNoControlCharactersAndKeepsItsMeaning)
{
    for (unsigned character = 0; character < 0x800; ++character) {
        std::string text = "a";
        if (character < 0x80)
            text += static_cast<char>(character);
        else {
            text += static_cast<char>(0xc0U | (character >> 6U));
            text += static_cast<char>(0x80U | (character & 0x3fU));
        }
        const std::string written = jsonText(nlohmann::json(text + "b"));
        EXPECT_EQ(written, plainText(written)) << character;
        EXPECT_EQ(nlohmann::json::parse(written).get<std::string>(), text + "b") << character;
    }
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
