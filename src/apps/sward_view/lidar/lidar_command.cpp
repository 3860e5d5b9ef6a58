#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/parse_text.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/lidar/lidar_options.h"
#include "apps/lidar/point_file.h"
#include "apps/lidar/point_writer.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/lidar/device_lidar.h"
#include "apps/sward_view/lidar/moved_blades.h"
#include "core/error.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "field/read.h"
#include "field/seeds/seeds.h"
#include "gpu/device/device.h"
#include "lidar/blade_quads.h"
#include "presentation/ground_surface.h"
#include "render/frame/frame_time.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sward::view {
namespace {

struct LidarCommand {
    apps::LidarOptions lidar;
    std::optional<double> time; ///< [s]
    MovedBy moved;
    std::string device;
    bool validation = false;
    apps::LogSwitches log;

    // By the renderer; else the blades stand at rest, or as a file says.
    bool isMoved() const { return time || moved.windStrength || !moved.settingsFile.empty(); }
};

void addMotion(CLI::App& app, LidarCommand& command)
{
    const char* const group = "Environment";
    app.add_option_function<std::string>(
           "--time",
           [&command](const std::string& text) {
               command.time = apps::parseNumber("--time", text, 0.0, render::longestTime);
           },
           "Blades as the wind has moved them at this time in seconds, see 'render'")
        ->type_name("S")
        ->group(group)
        ->default_str("0 with wind or settings, else at rest");
    app.add_option_function<std::string>(
           "--wind-strength",
           [&command](const std::string& text) {
               command.moved.windStrength =
                   static_cast<float>(apps::parseNumber("--wind-strength", text, 0, 1000));
           },
           "Total strength of all winds in blade heights per second, 0 to 1000; 0: calm")
        ->type_name("X")
        ->group(group)
        ->default_str("the field's");
    app.add_option("--settings", command.moved.settingsFile,
                   "Settings file: wind, gravity, colliders (keys: docs/settings.md)")
        ->type_name("FILE.json")
        ->group(group);
}

// Checks the options before any work.
void checkOptions(const LidarCommand& command)
{
    const apps::LidarOptions& options = command.lidar;
    options.check();
    if (command.isMoved() && !options.poses.empty())
        fail(ErrorKind::usage, "--blades says how the blades stand; then --time, --wind-strength "
                               "and --settings mean nothing");
    if (options.output.empty())
        return;
    apps::requirePointName(options.output);
    for (const std::string& source : {options.field, options.poses, options.beams})
        if (std::error_code ignored;
            !source.empty() && std::filesystem::equivalent(source, options.output, ignored))
            fail(ErrorKind::usage, "{}: is read and would be overwritten", options.output);
    apps::requireOutput(options.output, std::filesystem::path(options.output).extension().string(),
                        options.overwrite);
}

void warnOfSeeds(const field::FieldView& view, const std::string& file)
{
    if (view.seeds != nullptr && view.seeds->meadow->stored < 1.0)
        log::warn("{}: only the stored blades are measured, {:.3g} of those that grow from its "
                  "seeds; 'sward grow' makes a field of the others",
                  file, view.seeds->meadow->stored);
}

std::string ratesText(const DeviceLidar::Scan& scan, const std::string& device, double seconds,
                      bool isWritten)
{
    const auto beams = double(scan.counts.beams);
    const std::string whole =
        fmt::format("{:.2f} million {}", 1e-6 * beams / std::max(seconds, 1e-9),
                    isWritten ? "written" : "counted");
    if (!(scan.milliseconds > 0.0))
        return fmt::format("{} pulses a second on {}", whole, device);
    return fmt::format("{:.2f} million pulses a second on {}, {}", 1e-3 * beams / scan.milliseconds,
                       device, whole);
}

int measure(const LidarCommand& command)
{
    command.log.apply();
    checkOptions(command);
    const apps::LidarOptions& options = command.lidar;
    apps::requireField(options.field);
    const field::MappedField file = field::readField(options.field);
    const field::FieldView view = file.view();
    warnOfSeeds(view, options.field);
    const lidar::LidarSettings settings = options.settingsFor(view);
    const lidar::Beams beams = options.beamsOver(view, [&](double x, double z) {
        const double top = view.origin.y + double(view.bounds().high.y) + 1.0;
        const auto hit = presentation::GroundSurface(view).hit({x, top, z}, {0.0, -1.0, 0.0});
        return hit ? std::optional(hit->place.y) : std::nullopt;
    });

    apps::ProgressBar bar(command.log.showBar());
    Progress progress(bar.callback());
    const apps::CancelOnInterrupt cancel(progress);
    const gpu::Instance instance = createInstance(command.validation);
    const gpu::Device device(instance, {.selection = command.device});
    const unsigned threads = options.threads > 0
                                 ? static_cast<unsigned>(options.threads)
                                 : std::max(std::thread::hardware_concurrency(), 1u);

    // The blades as they stand, under a tree.
    Stopwatch watch;
    progress.begin("scene", 1);
    std::vector<field::BladePose> poses;
    if (command.isMoved()) {
        MovedBy moved = command.moved;
        moved.time = command.time.value_or(0.0);
        moved.device = command.device;
        moved.validation = command.validation;
        poses = movedPoses(options.field, view, moved);
    } else {
        poses = options.poses.empty() ? field::restingPoses(view, threads)
                                      : field::readPoses(view, options.poses);
    }
    std::optional<lidar::RayTree> tree =
        lidar::rayTreeOf(lidar::quadsOf(view, poses, threads), threads);
    poses = {};
    DeviceLidar sensor(device.context(), *tree, view.origin, settings, threads);
    log::debug("scene: {} quads, {} nodes, {} on the device, {:.1f} s", tree->quads.size(),
               tree->nodes.size(), apps::sizeText(sensor.treeBytes()), watch.lap());
    tree.reset();

    const std::vector<std::uint8_t> species = apps::speciesOfBlades(view);
    std::optional<apps::PointFile> points;
    std::optional<apps::PointWriter> writer;
    lidar::ReturnSink sink;
    if (!options.output.empty()) {
        points.emplace(options.output, view, species, options.overwrite);
        writer.emplace(*points, threads);
        sink = [&](lidar::ReturnParts some) { writer->add(std::move(some)); };
    }
    progress.begin("measuring", beams.count);
    watch.lap();
    const DeviceLidar::Scan scan = sensor.scan(beams, sink, progress);
    if (writer)
        writer->finish();
    const double seconds = watch.lap();
    if (points)
        points->commit();
    bar.clear();
    apps::writeResult(
        fmt::format("{}; {}\n", apps::countsText(options.output, scan.counts),
                    ratesText(scan, device.context().name, seconds, points.has_value())));
    failOnValidationMessages(instance);
    return 0;
}

} // namespace

void addLidarCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command = app.add_subcommand(
        "lidar", "Measure a field as a range sensor does, on a device: as 'sward lidar', faster");
    const auto options = std::make_shared<LidarCommand>();
    options->lidar.add(*command, false, "at rest, without wind");
    addMotion(*command, *options);
    command
        ->add_option("--device", options->device,
                     "Vulkan device, by the number or a part of the name that 'sward-view "
                     "devices' lists")
        ->type_name("N|NAME")
        ->group("Device")
        ->default_str("the best")
        ->envname("SWARD_DEVICE");
    command
        ->add_flag("--validation", options->validation,
                   "Run under the Vulkan validation layer; any message is a failure")
        ->group("Device");
    options->log.add(*command);
    options->log.addBar(*command);
    command->footer(
        "Example:\n  sward-view lidar meadow.sward -o points.npy --scanner 0,0 --above 1.8\n"
        "  sward-view lidar meadow.sward --airborne 60 --sweep 15 --spacing 0.02");
    command->final_callback(
        [options, &chosen] { chosen = [options] { return measure(*options); }; });
}

} // namespace sward::view
