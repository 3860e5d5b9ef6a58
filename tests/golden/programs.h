#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::golden {

/// Result of a program: exit code (−1 if a signal ended it) and output.
struct Finished {
    int code = -1;
    std::string output;
};

/// Runs a program to its end; stdout and stderr go to `log` and are returned.
Finished run(const std::filesystem::path& program, std::vector<std::string> arguments,
             const std::filesystem::path& log);

} // namespace sward::golden
