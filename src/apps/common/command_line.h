#pragma once

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

/// Runs a chosen command; returns the program's exit code.
using Command = std::function<int()>;

/// Sets up the common command line: --version, --help, --man, --completion, options before or after
/// the subcommand's name, no abbreviations.
void prepareApp(CLI::App& app, const std::string& program);

/// Parses the command line. Returns 0 after printing help or version on stdout, nothing when a
/// command was chosen. Throws Error{usage} for anything that CLI11 rejects; the message names the
/// nearest known option or command.
std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv);

} // namespace sward::apps
