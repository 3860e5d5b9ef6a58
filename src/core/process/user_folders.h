#pragma once

#include <filesystem>

namespace sward {

/// Where programs keep what they remember between runs: $XDG_STATE_HOME, if that is an absolute
/// path; else ~/.local/state, on Windows %LOCALAPPDATA%. Empty if there is no such folder.
std::filesystem::path userStateFolder();

/// The folder of the user's own files: $HOME, on Windows %USERPROFILE%. Empty if there is none.
std::filesystem::path userHomeFolder();

} // namespace sward
