#pragma once

#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace sward::apps {

/// Makes --help of `app`, and of the commands that are added to it afterwards, a page of 80 columns
/// whose form does not depend on the version of CLI11.
void useHelpText(CLI::App& app);

/// What stands in for the value of an option, or for a positional: "MIN:MAX", "FILE...". Empty for
/// a flag.
std::string valueName(const CLI::Option& option);

/// The description of an option, then in brackets whether it is required, its default, the options
/// that exclude it and its environment variable.
std::string describe(const CLI::Option& option);

} // namespace sward::apps
