#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "gpu/device/device_choice.h"
#include "gpu/device/device_report.h"
#include "gpu/device/instance.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace sward::view {
namespace {

int showDevices()
{
    const gpu::Instance instance = createInstance(false);
    const std::vector<gpu::DeviceReport> devices = gpu::listDevices(instance);
    if (!devices.empty())
        apps::writeResult(gpu::describe(devices));

    // Throw if no device is suitable.
    gpu::chooseDevice(devices, "");
    return 0;
}

} // namespace

void addDevicesCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("devices", "List the Vulkan devices, and why some cannot be used");
    const auto log = std::make_shared<apps::LogSwitches>();
    log->add(*command);
    command->footer("Example:\n  sward-view devices");
    command->final_callback([log, &chosen] {
        chosen = [log] {
            log->apply();
            return showDevices();
        };
    });
}

} // namespace sward::view
