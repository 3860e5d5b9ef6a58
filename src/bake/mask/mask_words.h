#pragma once

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::bake {

/// What is wrong with the words of a mask's text, such as "\"inverts\" is not …; did you mean
/// \"invert\"?". Empty if each word is known and in its place.
std::string maskTrouble(const std::string& text);

/// What is wrong with the words behind a map's name that "raster:FILE[:bN][:VALUES]" does not
/// know, and counts as part of the name; empty if there are none.
std::string rasterTrouble(const std::string& file);

/// Finite numbers with commas between them; empty if the text is anything else.
std::vector<double> classesOf(std::string_view text);

/// "A..B": finite numbers that differ by a finite one; none for any other text.
std::optional<glm::dvec2> rangeOf(std::string_view text);

} // namespace sward::bake
