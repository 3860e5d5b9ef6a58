#pragma once

#include <source_location>

namespace sward {

/// Ends the program with `message` and its source location.
[[noreturn]] void expectationFailed(const char* message, std::source_location where);

/// Checks an invariant of the program itself, in every build.
inline void expect(bool condition, const char* message,
                   std::source_location where = std::source_location::current())
{
    if (!condition) [[unlikely]]
        expectationFailed(message, where);
}

} // namespace sward
