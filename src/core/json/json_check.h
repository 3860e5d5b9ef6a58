#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sward {

inline constexpr std::size_t jsonDepthLimit = 128;       ///< nesting depth of arrays and objects
inline constexpr std::size_t jsonValueLimit = 8'000'000; ///< arrays, objects and commas

/// Checks that a text is one JSON value (RFC 8259, UTF-8) before a parser gets it: grammar, keys
/// that stand twice in one object, numbers beyond double precision, and the limits above. Throws
/// Error{input} in plain words that names `place`, line and column (from 1; a column counts bytes).
void requireJson(std::string_view text, const std::string& place);

} // namespace sward
