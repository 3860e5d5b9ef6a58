#include "apps/common/output.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/copy_bandwidth.h"
#include "apps/sward_view/headless/headless.h"
#include "apps/sward_view/headless/scene_field.h"
#include "core/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace sward::view {
namespace {

constexpr std::uint32_t maxFrames = 1'000'000;

// A device reaches its sustained clock within this time.
constexpr std::chrono::milliseconds minWarmUp(500);

struct BenchOptions {
    FrameOptions frame;
    std::uint32_t frames = 100;
    std::uint32_t warmup = 16;
    std::string fieldFolder; ///< empty: the scene's
    bool moving = false;
    bool copyBandwidth = false;
    bool json = false;
};

// Readable table: one line per pass.
std::string tableText(const RunStats& stats)
{
    std::string text = fmt::format("{} ({})\n{}x{}, {} samples, {} of {} blades drawn\n",
                                   stats.device, stats.driver, stats.size.x, stats.size.y,
                                   stats.samples, stats.blades.drawn, stats.blades.total);
    text += fmt::format("{:<10}{:>12}{:>12}{:>12}\n", "[ms]", "min", "median", "99% below");
    const auto line = [&text](const std::string& name, const gpu::Statistics& times) {
        text += fmt::format("{:<10}{:>12.4f}{:>12.4f}{:>12.4f}\n", name, times.min, times.median,
                            times.p99);
    };
    for (const auto& [name, times] : stats.gpuTimes)
        line(name, times);
    line("record", stats.recordTime);
    return text;
}

int benchCopies(const BenchOptions& options)
{
    const gpu::Instance instance = createInstance(options.frame.validation);
    const gpu::Device device(instance, {.selection = options.frame.device});
    const CopyBandwidth copies = measureCopies(device.context(), options.frames);
    apps::writeResult(
        options.json ? copyText(copies)
                     : fmt::format("{} ({})\n{} bytes copied by {} in {:.4f} ms: {:.1f} GB/s\n",
                                   copies.device, copies.driver, copies.bytes,
                                   copies.isShaderFaster() ? "a compute shader" : "command",
                                   copies.times().median, copies.gigabytesPerSecond()));
    failOnValidationMessages(instance);
    return 0;
}

// Opens a scene: bakes its field and applies its picture settings.
std::optional<SceneField> openScene(BenchOptions& options, const CLI::App& command)
{
    const auto& files = options.frame.fields;
    const auto found = std::find_if(files.begin(), files.end(), isScene);
    if (found == files.end()) {
        if (options.moving)
            fail(ErrorKind::usage, "--moving: {} is not a scene; only a scene has a path",
                 files.front());
        return std::nullopt;
    }
    if (files.size() > 1)
        fail(ErrorKind::usage, "{}: a scene is measured by itself, not with {} other files", *found,
             files.size() - 1);
    const Scene scene = readScene(*found);
    lookAt(scene, options.moving, command, options.frame);
    std::optional<SceneField> field;
    field.emplace(scene, options.fieldFolder, options.frame.log.showBar());
    options.frame.fields = {field->file().string()};
    return field;
}

// Warms up, resets the times, draws the measured frames.
WarmUp measureFrames(Headless& headless, const BenchOptions& options)
{
    apps::ProgressBar bar(options.frame.log.showBar());
    Progress progress(bar.callback());
    progress.begin("frames", std::uint64_t(options.warmup) + options.frames);

    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    WarmUp warmUp;
    // Repeat the first frame: the number of repetitions depends on the device, and must not affect
    // camera and blades in the measured frames.
    while (options.warmup > 0 && Clock::now() - begin < minWarmUp) {
        headless.draw(0);
        ++warmUp.frames;
    }
    for (std::uint64_t frame = 0; frame < options.warmup; ++frame) {
        headless.draw(frame);
        ++warmUp.frames;
        progress.advance(1);
    }
    warmUp.seconds = std::chrono::duration<double>(Clock::now() - begin).count();

    headless.forgetTimes();
    for (std::uint64_t frame = 0; frame < options.frames; ++frame) {
        headless.draw(options.warmup + frame);
        progress.advance(1);
    }
    return warmUp;
}

int bench(BenchOptions& options, const CLI::App& command)
{
    options.frame.log.apply();
    if (options.copyBandwidth)
        return benchCopies(options);
    if (options.frame.fields.empty())
        fail(ErrorKind::usage, "FILE is missing: a scene, or fields");
    const std::optional<SceneField> field = openScene(options, command);
    Headless::requireTime(options.frame, std::uint64_t(options.warmup) + options.frames);
    Headless headless(options.frame, {});
    headless.stream(0);

    const WarmUp warmUp = measureFrames(headless, options);
    RunStats stats = headless.stats();
    stats.warmUp = warmUp;
    apps::writeResult(options.json ? statsText(stats) : tableText(stats));
    failOnValidationMessages(headless.instance());
    return 0;
}

} // namespace

void addBenchCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("bench", "Measure how long frames of a scene or a field take");
    const auto options = std::make_shared<BenchOptions>();
    command
        ->add_option("FILE", options->frame.fields,
                     "Scene (.json, keys: docs/settings.md), or field files, drawn together")
        ->type_name("");
    options->frame.addShared(*command);
    options->frame.addMeasured(*command);
    command->add_option("--frames", options->frames, "Measured frames, 1 to 1 million")
        ->type_name("N")
        ->check(CLI::Range(std::uint32_t(1), maxFrames).description(""))
        ->capture_default_str();
    command
        ->add_option(
            "--warmup", options->warmup,
            "Frames before the measured ones, 0 to 1 million; above 0, the first is repeated "
            "until 0.5 s have passed")
        ->type_name("N")
        ->check(CLI::Range(std::uint32_t(0), maxFrames).description(""))
        ->capture_default_str();
    command
        ->add_option("--fields", options->fieldFolder,
                     "Folder of a scene's field; 'sward' bakes the field there if it is missing")
        ->type_name("DIR")
        ->default_str("the scene's folder");
    command->add_flag("--moving", options->moving, "Move the camera along the scene's path")
        ->excludes("--camera");
    command->add_flag("--copy-bandwidth", options->copyBandwidth,
                      "Measure copies within the device's memory; takes no FILE");
    command->add_flag("--json", options->json, "Print counts and times as JSON");
    options->frame.log.addBar(*command);
    command->footer("Example:\n  sward-view bench meadow.sward --camera eye --json\n"
                    "  sward-view bench assets/bench/1M.json --moving --fields /tmp");
    command->final_callback([options, command, &chosen] {
        chosen = [options, command] { return bench(*options, *command); };
    });
}

} // namespace sward::view
