#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sward::view {

/// Path of the program `sward` beside this one: in a build folder, in a bundle and when installed.
/// Throws Error{io} if it is missing; `purpose` tells what it is needed for.
std::filesystem::path swardProgram(const char* purpose);

/// `line` without the sequences that erase and colour it on a terminal.
std::string plainLine(std::string_view line);

} // namespace sward::view
