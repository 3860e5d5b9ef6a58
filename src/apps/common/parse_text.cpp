#include "apps/common/parse_text.h"

#include "core/error.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace sward::apps {
namespace {

// The whole text as a number; none if characters remain.
template <typename Number>
std::optional<Number> wholeText(std::string_view text)
{
    Number number{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end)
        return std::nullopt;
    return number;
}

// A decimal number or a fraction of two numbers.
std::optional<double> realNumber(std::string_view text)
{
    const std::size_t slash = text.find('/');
    const std::optional<double> number = wholeText<double>(text.substr(0, slash));
    if (slash == std::string_view::npos || !number)
        return number;
    const std::optional<double> divisor = wholeText<double>(text.substr(slash + 1));
    return divisor ? std::optional(*number / *divisor) : std::nullopt;
}

} // namespace

glm::uvec2 parseSize(std::string_view option, std::string_view text, std::uint32_t largest)
{
    const std::size_t cross = text.find('x');
    const auto width = wholeText<std::uint32_t>(text.substr(0, cross));
    const auto height = cross == std::string_view::npos
                            ? std::nullopt
                            : wholeText<std::uint32_t>(text.substr(cross + 1));
    if (!width || !height)
        fail(ErrorKind::usage, "{}: '{}' is not a size; write it like 1280x720", option, text);
    if (*width < 1 || *height < 1 || *width > largest || *height > largest)
        fail(ErrorKind::usage, "{}: {} is outside 1x1 to {}x{}", option, text, largest, largest);
    return {*width, *height};
}

double parseNumber(std::string_view option, std::string_view text, double low, double high)
{
    const std::optional<double> number = realNumber(text);
    if (!number || !std::isfinite(*number))
        fail(ErrorKind::usage, "{}: '{}' is not a number", option, text);
    if (*number < low || *number > high)
        fail(ErrorKind::usage, "{}: {} is outside [{}, {}]", option, text, low, high);
    return *number;
}

std::uint64_t parseBytes(std::string_view option, std::string_view text, std::uint64_t low,
                         std::uint64_t high)
{
    constexpr std::string_view letters = "KMGT";
    const std::size_t letter = text.empty() ? letters.npos : letters.find(text.back());
    const std::optional<double> number =
        wholeText<double>(letter == letters.npos ? text : text.substr(0, text.size() - 1));
    if (!number || !std::isfinite(*number) || *number < 0.0)
        fail(ErrorKind::usage, "{}: '{}' is not a size in bytes; write it like 512M or 2G", option,
             text);
    const double bytes =
        std::ldexp(*number, letter == letters.npos ? 0 : 10 * (static_cast<int>(letter) + 1));
    if (bytes < static_cast<double>(low) || bytes > static_cast<double>(high))
        fail(ErrorKind::usage, "{}: {} is outside [{}, {}] bytes", option, text, low, high);
    return static_cast<std::uint64_t>(bytes);
}

std::pair<double, double> parseRange(std::string_view option, std::string_view text)
{
    const std::vector<std::string_view> parts = splitText(text, ':');
    const std::optional<double> low = realNumber(parts.front());
    const std::optional<double> high = realNumber(parts.back());
    if (parts.size() != 2 || !low || !high || !std::isfinite(*low) || !std::isfinite(*high))
        fail(ErrorKind::usage, "{}: '{}' is not a range; write it like 0:45", option, text);
    if (*low > *high)
        fail(ErrorKind::usage, "{}: {} begins after its end", option, text);
    return {*low, *high};
}

std::pair<std::uint64_t, std::uint64_t>
parseWholeRange(std::string_view option, std::string_view text, std::uint64_t largest)
{
    const std::vector<std::string_view> parts = splitText(text, ':');
    const auto first = wholeText<std::uint64_t>(parts.front());
    const auto last = wholeText<std::uint64_t>(parts.back());
    if (parts.size() != 2 || !first || !last)
        fail(ErrorKind::usage, "{}: '{}' is not a range of whole numbers; write it like 0:120",
             option, text);
    if (*first > *last)
        fail(ErrorKind::usage, "{}: {} begins after its end", option, text);
    if (*last > largest)
        fail(ErrorKind::usage, "{}: {} ends after {}", option, text, largest);
    return {*first, *last};
}

std::vector<std::string_view> splitText(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    while (true) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos)
            return parts;
        begin = end + 1;
    }
}

} // namespace sward::apps
