#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Where a program is: the first of $PATH. Empty if it is not installed.
std::filesystem::path programNamed(const std::string& name);

/// Starts the program `arguments[0]`, a path; its stdout and stderr are written into the file
/// `said`, and it reads `input`, if given, as its stdin. Throws Error{runtime}, naming the program,
/// where it cannot be run.
pid_t startChild(std::vector<std::string> arguments, int said,
                 std::optional<int> input = std::nullopt);

/// How a program ended, and all that it said on stdout and stderr.
struct ChildEnd {
    int status = 0; ///< of waitpid()
    std::string said;
};

/// Runs the program `arguments[0]`, a path, and waits for its end. Throws as startChild().
ChildEnd runChild(std::vector<std::string> arguments);

} // namespace sward::view
