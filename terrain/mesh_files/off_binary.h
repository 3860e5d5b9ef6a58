#pragma once

#include <string>
#include <string_view>

namespace sward::terrain {

/// Converts a binary OFF to text. `keyword` is its first word; `body` follows the line "… BINARY".
/// Geomview writes big-endian with a colour component count per face; other programs use native
/// order or no count. Takes the layout that consumes every byte. Throws Error{input} naming `place`
/// if none does.
std::string offText(std::string_view keyword, std::string_view body, const std::string& place);

} // namespace sward::terrain
