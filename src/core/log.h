#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

namespace sward::log {

enum class Level { debug, info, warning, error };

/// Sets the lowest level that reaches stderr. The default is info.
void setLevel(Level level);

/// Shows `line` as the last line on stderr until the next call, for a progress bar. An empty text
/// removes it. Log lines are written above it. Callable from any thread. Needs a terminal with
/// control sequences.
void setStatusLine(const std::string& line);

/// Text for a terminal: control characters of files and arguments become \xNN, and a word of more
/// than 400 bytes loses its middle.
std::string printable(const std::string& text);

/// Writes one line to stderr, made printable. Programs log; libraries return numbers and fill
/// Diagnostics.
void write(Level level, const std::string& text);

template <typename... Args>
void debug(fmt::format_string<Args...> format, Args&&... args)
{
    write(Level::debug, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void info(fmt::format_string<Args...> format, Args&&... args)
{
    write(Level::info, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void warn(fmt::format_string<Args...> format, Args&&... args)
{
    write(Level::warning, fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void error(fmt::format_string<Args...> format, Args&&... args)
{
    write(Level::error, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace sward::log
