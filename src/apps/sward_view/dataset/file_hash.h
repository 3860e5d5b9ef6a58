#pragma once

#include <filesystem>
#include <string>

namespace sward::view {

/// A hash of a file's bytes: 16 hexadecimal digits. Throws Error{io} if it cannot be read.
std::string hashOfFile(const std::filesystem::path& path);

} // namespace sward::view
