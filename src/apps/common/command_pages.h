#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

// Manual page and completion, generated from the texts of --help.

/// The manual page in roff (man 7), with all commands.
std::string manualPage(const CLI::App& app, const std::string& program);

/// A script that bash sources: completes commands, options, the words that an option takes, and
/// files.
std::string bashCompletion(const CLI::App& app, const std::string& program);

} // namespace sward::apps
