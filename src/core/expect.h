#pragma once

#include <source_location>

namespace sward {

/// Ends the program with `message` and its place.
[[noreturn]] void expectationFailed(const char* message, std::source_location where);

/// States what must hold if the program itself is right; checked in every build.
inline void expect(bool condition, const char* message,
                   std::source_location where = std::source_location::current())
{
    if (!condition) [[unlikely]]
        expectationFailed(message, where);
}

} // namespace sward
