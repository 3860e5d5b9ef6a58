#pragma once

#include <string>
#include <vector>

namespace sward {

/// The arguments of main() as UTF-8, the program's name first. `argc` and `argv` are those of
/// main(): on Linux they hold the bytes that were given, on Windows they have lost what the
/// system's code page lacks, and the command line is read anew.
std::vector<std::string> programArguments(int argc, const char* const* argv);

} // namespace sward
