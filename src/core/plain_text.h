#pragma once

#include <string>
#include <string_view>

namespace sward {

/// The text with \xNN for each control character: NUL and the other C0 ones but line feed and tab,
/// DEL, and C1 ones as UTF-8. What files and arguments say then neither steers a terminal nor ends
/// a C string early.
std::string plainText(std::string_view text);

} // namespace sward
