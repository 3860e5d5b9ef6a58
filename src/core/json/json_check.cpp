#include "core/json/json_check.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace sward {
namespace {

bool isSpace(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

bool isWordPart(char c)
{
    return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

class JsonCheck {
public:
    JsonCheck(std::string_view text, const std::string& place)
        : text_(text)
        , place_(place)
    {
    }

    void run()
    {
        skipSpace();
        if (atEnd())
            fail(ErrorKind::input, "{}: not valid JSON: it is empty", place_);
        value();
        while (!open_.empty())
            inside();
        skipSpace();
        if (!atEnd())
            failAt(at_, "{} follows the end of the JSON value", found());
    }

private:
    // An array or object that is being read.
    struct Level {
        std::size_t begin; // of its bracket
        bool isObject;
        bool isFresh = true; // nothing read yet
        std::size_t firstKey = 0; // in keys_
    };
    struct Key {
        std::size_t begin; // of its quote
        std::size_t end;   // behind its last character
    };

    bool atEnd() const { return at_ >= text_.size(); }
    char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skipSpace()
    {
        while (!atEnd() && isSpace(text_[at_]))
            ++at_;
        if (here() == '/' && at_ + 1 < text_.size() &&
            (text_[at_ + 1] == '/' || text_[at_ + 1] == '*'))
            failAt(at_, "a comment, which JSON does not have");
    }

    std::size_t lineOf(std::size_t at) const
    {
        return 1 + static_cast<std::size_t>(std::count(
                       text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    }

    std::string placeOf(std::size_t at) const
    {
        at = std::min(at, text_.size());
        const std::size_t before = text_.substr(0, at).rfind('\n');
        const std::size_t column = at - (before == std::string_view::npos ? 0 : before + 1) + 1;
        return fmt::format("line {}, column {}", lineOf(at), column);
    }

    template <typename... Args>
    [[noreturn]] void failAt(std::size_t at, fmt::format_string<Args...> format,
                             Args&&... args) const
    {
        fail(ErrorKind::input, "{}: not valid JSON: {}: {}", place_, placeOf(at),
             fmt::format(format, std::forward<Args>(args)...));
    }

    // What stands here, for messages.
    std::string found() const
    {
        if (atEnd())
            return "the end of the text";
        std::size_t end = at_;
        while (end < text_.size() && end - at_ < 32 && isWordPart(text_[end]))
            ++end;
        if (end > at_)
            return fmt::format("\"{}\"", text_.substr(at_, end - at_));
        const auto byte = static_cast<unsigned char>(here());
        if (byte == '"')
            return "a text";
        return byte > 0x20 && byte < 0x7f ? fmt::format("\"{}\"", here())
                                          : fmt::format("the byte {:#04x}", byte);
    }

    void requireMore(std::size_t at) const
    {
        if (at < text_.size())
            return;
        if (open_.empty())
            failAt(text_.size(), "the text ends too early");
        failAt(text_.size(), "truncated: the text ends before the {} that opens at {} is closed",
               open_.back().isObject ? "object" : "array", placeOf(open_.back().begin));
    }

    // Reads a value; an array or object only up to its bracket.
    void value()
    {
        requireMore(at_);
        const char c = here();
        if (c == '{' || c == '[') {
            count();
            if (open_.size() >= jsonDepthLimit)
                failAt(at_, "nested more than {} deep", jsonDepthLimit);
            open_.push_back({.begin = at_, .isObject = c == '{', .firstKey = keys_.size()});
            ++at_;
        } else if (c == '"') {
            string();
        } else if (c == '-' || isDigit(c)) {
            number();
        } else {
            word();
        }
    }

    void count()
    {
        if (++values_ > jsonValueLimit)
            fail(ErrorKind::input, "{}: its JSON has {} values, more than {}", place_, values_,
                 jsonValueLimit);
    }

    // Reads the next member of the innermost array or object, or its end.
    void inside()
    {
        Level& level = open_.back();
        const char closing = level.isObject ? '}' : ']';
        const char* const what = level.isObject ? "object" : "array";
        skipSpace();
        requireMore(at_);
        if (here() == closing) {
            ++at_;
            close();
            return;
        }
        if (!level.isFresh) {
            const std::size_t comma = at_;
            if (here() != ',')
                failAt(at_, "expected a comma or \"{}\" of the {} that opens at {}, found {}",
                       closing, what, placeOf(level.begin), found());
            ++at_;
            count();
            skipSpace();
            requireMore(at_);
            if (here() == closing)
                failAt(comma, "a comma before \"{}\", with no value behind it", closing);
        }
        level.isFresh = false;
        if (level.isObject)
            key();
        value();
    }

    void key()
    {
        if (here() != '"')
            failAt(at_, "expected a key in double quotes, found {}", found());
        const std::size_t begin = at_;
        string();
        const std::size_t end = at_;
        keys_.push_back({begin, end});
        skipSpace();
        requireMore(at_);
        if (here() != ':')
            failAt(at_, "expected \":\" behind the key {}, found {}",
                   text_.substr(begin, std::min<std::size_t>(end - begin, 64)), found());
        ++at_;
        skipSpace();
    }

    // Keys of the object that ends here: none may stand twice.
    void close()
    {
        const Level level = open_.back();
        open_.pop_back();
        const auto first = keys_.begin() + static_cast<std::ptrdiff_t>(level.firstKey);
        if (keys_.end() - first > 1)
            requireOnce({first, keys_.end()});
        keys_.resize(level.firstKey);
    }

    void requireOnce(std::vector<Key> keys) const
    {
        const auto nameOf = [&](const Key& one) {
            return text_.substr(one.begin + 1, one.end - one.begin - 2);
        };
        const bool hasEscapes = std::any_of(keys.begin(), keys.end(), [&](const Key& one) {
            return nameOf(one).find('\\') != std::string_view::npos;
        });
        // Escapes are rare; only with them names are copied.
        std::vector<std::string> plain;
        if (hasEscapes)
            for (const Key& one : keys)
                plain.push_back(unescaped(nameOf(one)));
        std::vector<std::size_t> order(keys.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        const auto name = [&](std::size_t i) {
            return hasEscapes ? std::string_view(plain[i]) : nameOf(keys[i]);
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return name(a) < name(b); });
        for (std::size_t i = 1; i < order.size(); ++i)
            if (name(order[i]) == name(order[i - 1]))
                fail(ErrorKind::input,
                     "{}: {}: the key \"{}\" stands twice in one object, first at {}", place_,
                     placeOf(keys[order[i]].begin), name(order[i]).substr(0, 64),
                     placeOf(keys[order[i - 1]].begin));
    }

    static unsigned hexOf(std::string_view four)
    {
        return static_cast<unsigned>(std::strtoul(std::string(four).c_str(), nullptr, 16));
    }

    // A checked string without its escapes. What is no ASCII only needs to be unique.
    static std::string unescaped(std::string_view text)
    {
        std::string plain;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] != '\\') {
                plain += text[i];
                continue;
            }
            static constexpr std::string_view letters = "bfnrt";
            static constexpr std::string_view meaning = "\b\f\n\r\t";
            const char letter = text[++i];
            const std::size_t at = letters.find(letter);
            if (letter != 'u') {
                plain += at == std::string_view::npos ? letter : meaning[at];
                continue;
            }
            std::uint32_t code = hexOf(text.substr(i + 1, 4));
            i += 4;
            if (code >= 0xd800 && code < 0xdc00) {
                code = 0x10000 + ((code - 0xd800) << 10) + (hexOf(text.substr(i + 3, 4)) - 0xdc00);
                i += 6;
            }
            addUtf8(plain, code);
        }
        return plain;
    }

    static void addUtf8(std::string& text, std::uint32_t code)
    {
        if (code < 0x80) {
            text += static_cast<char>(code);
            return;
        }
        const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
        static constexpr std::uint32_t leads[] = {0, 0xc0, 0xe0, 0xf0};
        text += static_cast<char>(leads[more] | code >> (6 * more));
        for (int i = more - 1; i >= 0; --i)
            text += static_cast<char>(0x80U | (code >> (6 * i) & 0x3fU));
    }

    void string()
    {
        const std::size_t begin = at_++;
        while (true) {
            if (atEnd())
                failAt(begin, "truncated: the text in double quotes that begins here has no end");
            const auto byte = static_cast<unsigned char>(text_[at_]);
            if (byte == '"') {
                ++at_;
                return;
            }
            if (byte < 0x20)
                failAt(at_, "{}",
                       byte == '\n' || byte == '\r'
                           ? "a line ends inside a text; \\n stands for the end of a line"
                           : "a control character inside a text");
            if (byte == '\\')
                escape();
            else if (byte < 0x80)
                ++at_;
            else
                character(byte);
        }
    }

    bool isHex(std::size_t at) const
    {
        for (std::size_t i = at; i < at + 4; ++i)
            if (i >= text_.size() || !std::isxdigit(static_cast<unsigned char>(text_[i])))
                return false;
        return true;
    }

    void escape()
    {
        const std::size_t begin = at_++;
        const char letter = here();
        if (letter != 'u') {
            if (atEnd() || std::string_view("\"\\/bfnrt").find(letter) == std::string_view::npos)
                failAt(begin, "\\ before {}: JSON has \\\\ for a \\ itself, \\\", \\/, \\b, \\f, "
                              "\\n, \\r, \\t and \\uXXXX",
                       found());
            ++at_;
            return;
        }
        if (!isHex(at_ + 1))
            failAt(begin, "\\u without four hexadecimal digits");
        const unsigned code = hexOf(text_.substr(at_ + 1, 4));
        at_ += 5;
        const bool isPaired = text_.substr(at_, 2) == "\\u" && isHex(at_ + 2) &&
                              (hexOf(text_.substr(at_ + 2, 4)) & 0xfc00U) == 0xdc00U;
        if ((code & 0xfc00U) == 0xdc00U || ((code & 0xfc00U) == 0xd800U && !isPaired))
            failAt(begin, "half of a surrogate pair without the other");
        if ((code & 0xfc00U) == 0xd800U)
            at_ += 6;
    }

    // A character of several bytes of UTF-8: no longer than needed, no surrogate, up to U+10FFFF.
    void character(unsigned lead)
    {
        const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
        std::uint32_t code = lead & (0x3fU >> more);
        bool isSound = lead >= 0xc2 && lead <= 0xf4;
        for (int i = 1; i <= more && isSound; ++i) {
            const std::size_t at = at_ + static_cast<std::size_t>(i);
            const unsigned byte = at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0U;
            isSound = (byte & 0xc0U) == 0x80U;
            code = code << 6 | (byte & 0x3fU);
        }
        if (!isSound || (more == 2 && code < 0x800) || (more == 3 && code < 0x10000) ||
            (code >= 0xd800 && code < 0xe000) || code > 0x10ffff)
            failAt(at_, "the byte {:#04x} is not UTF-8; save the file as UTF-8", lead);
        at_ += static_cast<std::size_t>(more) + 1;
    }

    std::size_t digits()
    {
        const std::size_t begin = at_;
        while (isDigit(here()))
            ++at_;
        return at_ - begin;
    }

    void number()
    {
        const std::size_t begin = at_;
        const auto require = [&](bool holds, const char* what) {
            if (!holds)
                failAt(begin, "\"{}\" is not a number of JSON: {}",
                       text_.substr(begin, std::min<std::size_t>(at_ + 1 - begin, 32)), what);
        };
        if (here() == '-')
            ++at_;
        const bool startsWithZero = here() == '0';
        const std::size_t whole = digits();
        require(whole > 0, "a digit is missing");
        require(!startsWithZero || whole == 1, "it begins with a needless 0");
        bool isPlain = whole < 300;
        if (here() == '.') {
            ++at_;
            require(digits() > 0, "no digit follows its point");
        }
        if (here() == 'e' || here() == 'E') {
            ++at_;
            if (here() == '+' || here() == '-')
                ++at_;
            require(digits() > 0, "no digit follows its exponent");
            isPlain = false;
        }
        require(!isWordPart(here()) && here() != '.', "letters or a second point follow it");
        if (isPlain)
            return;
        const std::string copy(text_.substr(begin, at_ - begin));
        if (!(std::abs(std::strtod(copy.c_str(), nullptr)) <= 1.7976931348623157e308))
            failAt(begin, "{} is too large for a number", copy.substr(0, 32));
    }

    void word()
    {
        std::size_t end = at_;
        while (end < text_.size() && isWordPart(text_[end]))
            ++end;
        const std::string_view name = text_.substr(at_, end - at_);
        if (name == "true" || name == "false" || name == "null") {
            at_ = end;
            return;
        }
        if (here() == '\'')
            failAt(at_, "a text in single quotes; those of JSON are in double quotes");
        if (here() == ',' || here() == ']' || here() == '}' || here() == ':')
            failAt(at_, "a value is missing before {}", found());
        failAt(at_, "expected a value, found {}{}", found(),
               name.empty() ? "" : "; a text is in double quotes, and words are true, false, null");
    }

    std::string_view text_;
    const std::string& place_;
    std::size_t at_ = 0;
    std::size_t values_ = 0;
    std::vector<Level> open_;
    std::vector<Key> keys_;
};

} // namespace

void requireJson(std::string_view text, const std::string& place)
{
    JsonCheck(text, place).run();
}

} // namespace sward
