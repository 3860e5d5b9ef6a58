#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sward {

/// A hash of bytes: 16 hexadecimal digits.
std::string hashOfBytes(std::span<const std::byte> bytes);

/// The same of a text.
std::string hashOfText(std::string_view text);

/// A hash of a file's bytes: 16 hexadecimal digits. Throws Error{io} if it cannot be read.
std::string hashOfFile(const std::filesystem::path& path);

} // namespace sward
