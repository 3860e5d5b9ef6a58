#pragma once

#include <filesystem>
#include <string>

namespace sward {

/// The file of the program that runs; empty if the system does not tell.
std::filesystem::path programPath();

/// The folder of the program, or of the library that holds this code.
std::filesystem::path ownFolder();

/// The file beside it, or anywhere, that holds the program `name`: with ".exe" on Windows.
std::filesystem::path programFile(const std::filesystem::path& name);

/// Path of an installed program, by its name without an ending: the first in $PATH. Empty if it is
/// not installed.
std::filesystem::path programNamed(const std::string& name);

/// Whether `file` is a program that may be run.
bool isProgram(const std::filesystem::path& file);

} // namespace sward
