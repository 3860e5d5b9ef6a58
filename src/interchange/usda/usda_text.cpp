#include "interchange/usda/usda_text.h"

#include <fmt/format.h>

namespace sward::interchange {

std::string usdString(std::string_view text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (quoted += '\\') += c;
        else if (c == '\n')
            quoted += "\\n";
        else if (static_cast<unsigned char>(c) < ' ')
            quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        else
            quoted += c;
    }
    return quoted + '"';
}

std::string usdIdentifier(std::string_view name)
{
    std::string identifier;
    for (const char c : name) {
        const bool isAllowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                               (c >= '0' && c <= '9' && !identifier.empty()) || c == '_';
        identifier += isAllowed ? c : '_';
    }
    return identifier.empty() ? "_" : identifier;
}

} // namespace sward::interchange
