#pragma once

#include <functional>
#include <string_view>

namespace sward::apps {

/// The body of main(). Runs `body` and returns its exit code. Prints an exception on stderr and
/// returns its exit code: that of an Error, else 4. Signals only set the flag of
/// interrupt.h meanwhile; if `body` then returns 0, the result is valid.
int runProgram(std::string_view name, const std::function<int()>& body) noexcept;

} // namespace sward::apps
