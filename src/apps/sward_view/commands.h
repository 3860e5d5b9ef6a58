#pragma once

#include "apps/common/command_line.h"

namespace CLI {
class App;
}

namespace sward::view {

// Each adds one command to the command line. When it is the one that was chosen, parsing sets
// `chosen` to what it does.

void addRenderCommand(CLI::App& app, apps::Command& chosen);
void addBenchCommand(CLI::App& app, apps::Command& chosen);
void addDevicesCommand(CLI::App& app, apps::Command& chosen);

/// The window: the program's own positional argument and options, without a command's name.
void addWindowCommand(CLI::App& app, apps::Command& chosen);

} // namespace sward::view
