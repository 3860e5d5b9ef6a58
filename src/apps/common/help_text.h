#pragma once

#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace sward::apps {

/// Sets the --help format of `app` and of commands added afterwards: 80 columns, independent of the
/// version of CLI11.
void useHelpText(CLI::App& app);

/// Placeholder of the value of an option or positional: "MIN:MAX", "FILE...". Empty for a flag.
std::string valueName(const CLI::Option& option);

/// The description of an option. Brackets add: required, its default, the options that exclude it,
/// its environment variable.
std::string describe(const CLI::Option& option);

} // namespace sward::apps
