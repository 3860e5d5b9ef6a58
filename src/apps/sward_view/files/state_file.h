#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace sward::view {

/// Path of a file kept between runs: sward/NAME in userStateFolder(). Empty if there is no
/// such folder.
std::filesystem::path stateFile(const std::string& name);

/// Changes a state file that other windows change, too: under a lock, `change` gets its content
/// (empty if it is missing) and returns what is written instead, whole or not at all. Throws
/// Error{io} if the file cannot be read, locked or written, Error{input} if it is larger than 8
/// MiB, and what `change` throws.
void changeState(const std::filesystem::path& file,
                 const std::function<std::string(const std::string&)>& change);

/// The content of a state file; empty if it is missing. Throws as changeState() does.
std::string readState(const std::filesystem::path& file);

/// Key of `input` in state files: an absolute path for a file, the name for a built-in ground.
std::string stateNameOf(const std::string& input);

} // namespace sward::view
