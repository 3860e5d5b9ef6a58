#pragma once

#include <string>
#include <string_view>

namespace sward::terrain {

/// The text of a binary OFF; `keyword` is its first word and `body` what lies behind the line
/// "… BINARY". Geomview writes it big-endian and with a number of colour components for each face,
/// others in the machine's order or without: whatever uses up every byte is taken. Throws
/// Error{input} naming `place` if nothing does.
std::string offText(std::string_view keyword, std::string_view body, const std::string& place);

} // namespace sward::terrain
