#pragma once

namespace sward {

/// Lets stdin, stdout and stderr carry the program's bytes as they are, text as UTF-8. To be called
/// once, before anything is printed.
void prepareStandardStreams() noexcept;

/// Whether stderr is a terminal; on Windows one that has been told to take control sequences.
bool stderrIsConsole() noexcept;

/// Columns of the terminal at stderr; 0 if unknown.
int stderrConsoleColumns() noexcept;

} // namespace sward
