#pragma once

#include <filesystem>
#include <string>

namespace sward::view {

/// Path of a file kept between runs: $XDG_STATE_HOME/sward/NAME (~/.local/state by default). Empty
/// if there is no such folder.
std::filesystem::path stateFile(const std::string& name);

/// Writes a state file. Ignores errors, because the state is not essential.
void keepState(const std::filesystem::path& file, const std::string& text);

/// Key of `input` in state files: an absolute path for a file, the name for a built-in ground.
std::string stateNameOf(const std::string& input);

} // namespace sward::view
