#include "core/json/json_text.h"

#include "core/error.h"

#include <nlohmann/json.hpp>

namespace sward {
namespace {

constexpr const char* percentKey = "percent";

int hexDigit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    const char upper = static_cast<char>(c & ~0x20);
    return upper >= 'A' && upper <= 'F' ? upper - 'A' + 10 : -1;
}

// The same JSON with \u00NN for DEL and C1 characters, which the library writes as they are. They
// occur in strings only.
std::string withoutControls(std::string json)
{
    if (json.find_first_of("\x7f\xc2") == std::string::npos)
        return json;
    std::string plain;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const auto next = static_cast<unsigned char>(i + 1 < json.size() ? json[i + 1] : 0);
        if (json[i] == '\x7f')
            plain += "\\u007f";
        else if (json[i] == '\xc2' && next < 0xa0)
            plain += fmt::format("\\u{:04x}", static_cast<unsigned char>(json[++i]));
        else
            plain += json[i];
    }
    return plain;
}

} // namespace

std::string jsonText(const nlohmann::json& value, int indent)
{
    return withoutControls(
        value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string jsonText(const nlohmann::ordered_json& value, int indent)
{
    return withoutControls(
        value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

std::string toUtf8(std::string_view bytes)
{
    return nlohmann::json::parse(jsonText(nlohmann::json(bytes))).get<std::string>();
}

bool isUtf8(std::string_view bytes)
{
    try {
        static_cast<void>(nlohmann::json(bytes).dump());
        return true;
    } catch (const nlohmann::json::type_error&) {
        return false;
    }
}

nlohmann::json bytesToJson(std::string_view bytes)
{
    if (isUtf8(bytes))
        return bytes;
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > 0x20 && byte < 0x7f && c != '%')
            text += c;
        else
            text += fmt::format("%{:02X}", byte);
    }
    return {{percentKey, text}};
}

std::string bytesFromJson(const nlohmann::json& value, const std::string& place)
{
    if (value.is_string())
        return value.get<std::string>();
    if (!value.is_object() || value.size() != 1 || !value.contains(percentKey) ||
        !value.at(percentKey).is_string())
        fail(ErrorKind::input, R"({}: expected a text or {{"percent": TEXT}}, found {})", place,
             jsonText(value));
    const std::string text = value.at(percentKey).get<std::string>();
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            bytes += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
        if (low < 0)
            fail(ErrorKind::input, "{}: \"{}\" has a % without two hexadecimal digits", place,
                 text);
        bytes += static_cast<char>(16 * high + low);
        i += 2;
    }
    return bytes;
}

} // namespace sward
