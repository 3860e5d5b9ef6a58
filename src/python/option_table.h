#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::python {

/// Parses options as a command line holds them, without the program's name. Throws Error{usage}.
void parseOptions(CLI::App& app, std::vector<std::string> arguments);

} // namespace sward::python
