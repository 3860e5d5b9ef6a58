#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

/// What messages of the sower need of the library fmt, which would be larger than the sower.
namespace fmt {

template <typename... Args>
using format_string = std::string_view;

inline void append(std::string& text, std::string_view value)
{
    text += value;
}

template <typename Number>
    requires std::is_integral_v<Number>
void append(std::string& text, Number value)
{
    char digits[24];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Each "{}" stands for an argument; there are no other forms.
template <typename... Args>
std::string format(std::string_view pattern, const Args&... args)
{
    std::string text;
    const auto put = [&](const auto& value) {
        const std::size_t place = pattern.find("{}");
        text += pattern.substr(0, place);
        append(text, value);
        pattern.remove_prefix(place + 2);
    };
    (put(args), ...);
    return text.append(pattern);
}

} // namespace fmt
