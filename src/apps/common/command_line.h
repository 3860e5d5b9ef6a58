#pragma once

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

/// What a chosen command does; its result is the program's exit code.
using Command = std::function<int()>;

/// Sets what every command line of the project has: --version, --help, --man, --completion, options
/// before or after the subcommand's name, no abbreviations.
void prepareApp(CLI::App& app, const std::string& program);

/// Parses the command line. Returns 0 when help or version was asked for and printed on stdout,
/// nothing when there is work to do. Throws Error{usage} for whatever CLI11 refuses; the message
/// names the nearest known option or command.
std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv);

} // namespace sward::apps
