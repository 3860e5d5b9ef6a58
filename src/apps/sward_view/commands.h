#pragma once

#include "apps/common/command_line.h"

namespace CLI {
class App;
}

namespace sward::view {

// Each function adds one command to the command line. Parsing sets `chosen` to the chosen command's
// action.

void addRenderCommand(CLI::App& app, apps::Command& chosen);
void addBenchCommand(CLI::App& app, apps::Command& chosen);
void addDatasetCommand(CLI::App& app, apps::Command& chosen);
void addLidarCommand(CLI::App& app, apps::Command& chosen);
void addDevicesCommand(CLI::App& app, apps::Command& chosen);

/// The window: positional arguments and options of the program itself, without a command.
void addWindowCommand(CLI::App& app, apps::Command& chosen);

} // namespace sward::view
