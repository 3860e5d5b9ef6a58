#include "core/plain_text.h"

#include <fmt/core.h>

#include <cstddef>

namespace sward {
namespace {

// Length of the UTF-8 control character at `i`. 0: none.
std::size_t controlAt(std::string_view text, std::size_t i)
{
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f)
        return 1;
    const bool isC1 = byte == 0xc2 && i + 1 < text.size() &&
                      static_cast<unsigned char>(text[i + 1]) >= 0x80 &&
                      static_cast<unsigned char>(text[i + 1]) < 0xa0;
    return isC1 ? 2 : 0;
}

} // namespace

std::string plainText(std::string_view text)
{
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t i = 0; i < text.size();)
        if (const std::size_t length = controlAt(text, i); length > 0) {
            plain += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i + length - 1]));
            i += length;
        } else {
            plain += text[i++];
        }
    return plain;
}

} // namespace sward
