#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Starts the program `arguments[0]`, a path; its stderr is written into the file `said`, and it
/// reads `input`, if given, as its stdin. Throws Error{runtime}, naming the program, where it
/// cannot be run.
pid_t startChild(std::vector<std::string> arguments, int said,
                 std::optional<int> input = std::nullopt);

} // namespace sward::view
