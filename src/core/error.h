#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace sward {

/// Category of an Error. The value is the exit code of the programs.
enum class ErrorKind {
    usage = 1,       ///< the command line or a setting is wrong
    io = 2,          ///< a file cannot be read or written, or would be overwritten
    input = 3,       ///< a file was read, but its content is not valid
    runtime = 4,     ///< the device was lost, there is no display
    unsupported = 5, ///< valid, but not supported: an extension, a file version, no Vulkan device
    difference = 7,  ///< a comparison found a difference
    interrupted = 130,
};

/// The only exception that Sward throws: for faults outside the program. Its message names the
/// file, the item, the value and the bound, so that a user can correct it.
class Error : public std::runtime_error {
public:
    /// Use fail(). Control characters of the message become \\xNN (plainText()): none cuts what().
    Error(ErrorKind kind, const std::string& message);

    ErrorKind kind() const { return kind_; }                 ///< what is wrong
    int exitCode() const { return static_cast<int>(kind_); } ///< of a program that this error ends

private:
    ErrorKind kind_;
};

/// Throws an Error with a formatted message.
template <typename... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args)
{
    throw Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

/// Throws Error{usage} with a formatted message unless what a caller gives is as it must be.
template <typename... Args>
void requireUsage(bool holds, fmt::format_string<Args...> format, Args&&... args)
{
    if (!holds) [[unlikely]]
        fail(ErrorKind::usage, format, std::forward<Args>(args)...);
}

} // namespace sward
