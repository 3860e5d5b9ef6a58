#pragma once

#include <string>

namespace sward::bake {

/// What is wrong with the words of a mask's text, such as "\"inverts\" is not …; did you mean
/// \"invert\"?". Empty if each word is known and in its place.
std::string maskTrouble(const std::string& text);

} // namespace sward::bake
