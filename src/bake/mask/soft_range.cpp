#include "bake/mask/soft_range.h"

#include "core/error.h"

#include <charconv>
#include <cmath>

namespace sward::bake {
namespace {

// Reads a finite number that is all of the text.
bool readNumber(const std::string& text, double& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// Cuts the text at the first separator; false if there is none, or a second one.
bool cut(const std::string& text, char separator, std::string& first, std::string& second)
{
    const std::size_t at = text.find(separator);
    if (at == std::string::npos || text.find(separator, at + 1) != std::string::npos)
        return false;
    first = text.substr(0, at);
    second = text.substr(at + 1);
    return true;
}

// Removes "~SOFT" from the end of the text and reads it.
bool readSoft(std::string& text, double& soft)
{
    std::string rest;
    std::string softText;
    if (text.find('~') == std::string::npos)
        return true;
    if (!cut(text, '~', rest, softText) || !readNumber(softText, soft) || soft < 0.0)
        return false;
    text = rest;
    return true;
}

} // namespace

double SoftRange::weight(double value) const
{
    if (value >= low && value <= high)
        return 1.0;
    if (soft <= 0.0)
        return 0.0;
    const double outside = value < low ? low - value : value - high;
    return outside >= soft ? 0.0 : 1.0 - outside / soft;
}

std::optional<SoftRange> readSoftRange(const std::string& text, const SoftRange& full)
{
    SoftRange range = full;
    std::string ends = text;
    std::string low;
    std::string high;
    if (!readSoft(ends, range.soft) || !cut(ends, ':', low, high) ||
        (!low.empty() && !readNumber(low, range.low)) ||
        (!high.empty() && !readNumber(high, range.high)) || range.low > range.high)
        return std::nullopt;
    return range;
}

std::string textOf(const SoftRange& range)
{
    const auto end = [](double value) {
        return std::fabs(value) >= unbounded ? std::string() : fmt::format("{}", value);
    };
    return fmt::format("{}:{}{}", end(range.low), end(range.high),
                       range.soft > 0.0 ? fmt::format("~{}", range.soft) : "");
}

SoftRange parseSoftRange(const std::string& option, const std::string& text, SoftRange full)
{
    const std::optional<SoftRange> range = readSoftRange(text, full);
    if (!range)
        fail(ErrorKind::usage,
             "{} is \"{}\"; expected MIN:MAX or MIN:MAX~SOFT with MIN <= MAX, SOFT >= 0", option,
             text);
    return *range;
}

SoftRange parseSoftMinimum(const std::string& option, const std::string& text)
{
    SoftRange range;
    std::string least = text;
    if (!readSoft(least, range.soft) || !readNumber(least, range.low))
        fail(ErrorKind::usage, "{} is \"{}\"; expected M or M~SOFT with SOFT >= 0", option, text);
    range.low += range.soft;
    return range;
}

} // namespace sward::bake
