#pragma once

#include <string>

namespace sward {

/// The text with the letters A to Z in small; all other bytes are kept, whatever the locale.
inline std::string lowerCase(std::string text)
{
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

} // namespace sward
