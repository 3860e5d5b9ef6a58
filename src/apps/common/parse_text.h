#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::apps {

// Parsers of command-line values. Each throws Error{usage} naming `option`, the text and the
// expected form.

/// "1920x1080": width and height, each in [1, largest].
glm::uvec2 parseSize(std::string_view option, std::string_view text, std::uint32_t largest);

/// A whole text as a finite number in [low, high]; "1/60" is a number too.
double parseNumber(std::string_view option, std::string_view text, double low, double high);

/// "512M", "1.5G": a number of bytes in [low, high]; K, M, G and T are powers of 1024, no letter is
/// a byte.
std::uint64_t parseBytes(std::string_view option, std::string_view text, std::uint64_t low,
                         std::uint64_t high);

/// "A:B": two finite numbers, A ≤ B.
std::pair<double, double> parseRange(std::string_view option, std::string_view text);

/// "A:B": two whole numbers, 0 ≤ A ≤ B ≤ largest.
std::pair<std::uint64_t, std::uint64_t>
parseWholeRange(std::string_view option, std::string_view text, std::uint64_t largest);

/// The parts of `text` between `separator`s; one empty part for an empty text.
std::vector<std::string_view> splitText(std::string_view text, char separator);

} // namespace sward::apps
