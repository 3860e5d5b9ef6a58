#pragma once

#include <filesystem>
#include <string>

namespace sward::view {

/// Where something is kept between runs: $XDG_STATE_HOME/sward/NAME (~/.local/state by default).
/// Empty where there is no such place.
std::filesystem::path stateFile(const std::string& name);

/// Writes what is kept there. That it cannot be written disturbs nobody: it is a comfort, not a
/// result.
void keepState(const std::filesystem::path& file, const std::string& text);

/// What is kept under for `input`: a file is found again from any folder, a built-in ground has
/// none.
std::string stateNameOf(const std::string& input);

} // namespace sward::view
