#include "terrain/gltf/file/uri.h"

#include "terrain/files/near_file.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace sward::terrain {
namespace {

// Whether `text` begins with `start`, which has small letters, in letters of any case.
bool beginsWith(std::string_view text, std::string_view start)
{
    return std::equal(text.begin(),
                      text.begin() +
                          static_cast<std::ptrdiff_t>(std::min(text.size(), start.size())),
                      start.begin(), start.end(), [](char a, char b) {
                          return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
                      });
}

int hexDigit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

// A % without two digits is kept literally; some exporters write it.
std::string decodePercent(std::string_view text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = i + 2 < text.size() && text[i] == '%' ? hexDigit(text[i + 1]) : -1;
        const int low = high < 0 ? -1 : hexDigit(text[i + 2]);
        if (low < 0) {
            decoded.push_back(text[i]);
            continue;
        }
        decoded.push_back(static_cast<char>(16 * high + low));
        i += 2;
    }
    return decoded;
}

constexpr std::uint8_t noDigit = 64;

constexpr std::array<std::uint8_t, 256> base64Values()
{
    std::array<std::uint8_t, 256> values{};
    for (std::uint8_t& value : values)
        value = noDigit;
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    values['-'] = 62; // the alphabet for URIs
    values['_'] = 63;
    return values;
}

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text)
{
    static constexpr std::array<std::uint8_t, 256> values = base64Values();
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t value = values[static_cast<unsigned char>(text[i])];
        if (value == noDigit)
            return std::nullopt;
        group = (group << 6) | value;
        // Each digit but the first of four completes a byte.
        if (i % 4 != 0)
            bytes.push_back(static_cast<std::byte>((group >> (6 - 2 * (i % 4))) & 0xffU));
    }
    return bytes;
}

} // namespace

std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri)
{
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
        return std::nullopt;
    constexpr std::string_view base64 = ";base64";
    const std::string_view head = uri.substr(0, comma);
    const std::string_view content = uri.substr(comma + 1);
    if (head.size() >= base64.size() &&
        beginsWith(head.substr(head.size() - base64.size()), base64))
        return decodeBase64(content);
    const std::string plain = decodePercent(content);
    const auto* const bytes = reinterpret_cast<const std::byte*>(plain.data());
    return std::vector<std::byte>(bytes, bytes + plain.size());
}

bool isDataUri(std::string_view uri)
{
    return beginsWith(uri, "data:");
}

bool isOnNetwork(std::string_view uri)
{
    for (const std::string_view scheme : {"http://", "https://", "ftp://", "ftps://", "s3://"})
        if (beginsWith(uri, scheme))
            return true;
    return false;
}

std::filesystem::path fileBeside(const std::filesystem::path& gltf, std::string_view uri,
                                 const std::string& place, Diagnostics& diagnostics)
{
    std::string name = decodePercent(uri);
    // The system would cut the path at a zero byte; use an empty name instead.
    if (name.find('\0') != std::string::npos)
        name.clear();
    return fileOrNear(gltf.parent_path(), name, place, diagnostics);
}

} // namespace sward::terrain
