#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Path of a program: the first in $PATH. Empty if it is not installed.
std::filesystem::path programNamed(const std::string& name);

/// Starts the program `arguments[0]`, a path. Writes its stdout and stderr to the file `said`; it
/// reads `input`, if given, as its stdin. Throws Error{runtime} naming the program if it cannot be
/// run.
pid_t startChild(std::vector<std::string> arguments, int said,
                 std::optional<int> input = std::nullopt);

/// The same with three files of its own: it reads `input`, and writes stdout to `output` and stderr
/// to `said`.
pid_t startTalkingChild(std::vector<std::string> arguments, int input, int output, int said);

/// Exit status of a program and its output on stdout and stderr.
struct ChildEnd {
    int status = 0; ///< of waitpid()
    std::string said;
};

/// Runs the program `arguments[0]`, a path, and waits for its end. Throws as startChild().
ChildEnd runChild(std::vector<std::string> arguments);

} // namespace sward::view
