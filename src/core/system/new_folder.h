#pragma once

#include <filesystem>

namespace sward {

/// Makes a folder for this user alone, whose name is new: `start`, a dot and some letters. Returns
/// its path. Throws Error{io} with the reason if it cannot be made.
std::filesystem::path makeNewFolder(const std::filesystem::path& start);

} // namespace sward
