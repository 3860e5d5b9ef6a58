#include "apps/common/command_line.h"
#include "apps/common/program.h"
#include "apps/sward_view/commands.h"

#include <CLI/CLI.hpp>

namespace {

constexpr const char* about =
    "Shows fields of grass that 'sward bake' has written. Without a command it opens a window.";

} // namespace

int main(int argc, char** argv)
{
    using namespace sward;
    return apps::runProgram("sward-view", [argc, argv] {
        CLI::App app(about);
        apps::prepareApp(app, "sward-view");
        apps::Command chosen;
        view::addWindowCommand(app, chosen);
        view::addRenderCommand(app, chosen);
        view::addBenchCommand(app, chosen);
        view::addDatasetCommand(app, chosen);
        view::addLidarCommand(app, chosen);
        view::addDevicesCommand(app, chosen);
        if (const std::optional<int> done = apps::parseCommandLine(app, argc, argv))
            return *done;
        return chosen();
    });
}
