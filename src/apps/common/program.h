#pragma once

#include <functional>
#include <string_view>

namespace sward::apps {

/// The body of main(). Runs `body` and returns its exit code; whatever it throws becomes a message
/// on stderr and an exit code: Error its own, everything else 4. While it runs, SIGINT and SIGTERM
/// only raise the flag of interrupt.h; if `body` then returns 0 the result stands.
int runProgram(std::string_view name, const std::function<int()>& body) noexcept;

} // namespace sward::apps
