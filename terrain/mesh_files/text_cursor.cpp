#include "terrain/mesh_files/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sward::terrain {
namespace {

bool isSpace(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

} // namespace

std::string_view TextCursor::line()
{
    const std::size_t begin = std::min(at_, text_.size());
    std::size_t end = begin;
    while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r')
        ++end;
    const bool isPair = end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n';
    at_ = end + (isPair ? 2 : 1);
    ++lineNumber_;
    return text_.substr(begin, end - begin);
}

std::string_view TextCursor::word()
{
    while (at_ < text_.size() && isSpace(text_[at_]))
        ++at_;
    const std::size_t begin = std::min(at_, text_.size());
    while (at_ < text_.size() && !isSpace(text_[at_]))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

std::optional<double> TextCursor::number()
{
    return parseNumber(word());
}

std::size_t lineAt(std::string_view text, std::size_t offset)
{
    TextCursor cursor(text);
    do
        cursor.line();
    while (!cursor.atEnd() && cursor.offset() < offset);
    return cursor.lineNumber();
}

std::size_t filledLines(std::string_view text, char comment)
{
    std::size_t count = 0;
    for (TextCursor cursor(text); !cursor.atEnd();) {
        std::string_view line = cursor.line();
        if (comment != '\0')
            line = line.substr(0, line.find(comment));
        count += std::all_of(line.begin(), line.end(), isSpace) ? 0U : 1U;
    }
    return count;
}

std::optional<double> parseNumber(std::string_view word)
{
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<std::size_t> parseCount(std::string_view word)
{
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        return std::nullopt;
    return value;
}

} // namespace sward::terrain
