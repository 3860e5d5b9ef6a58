#include "apps/common/output.h"
#include "apps/common/progress_bar.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless.h"
#include "core/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <string>

namespace sward::view {
namespace {

constexpr std::uint32_t mostFrames = 1'000'000;

struct BenchOptions {
    FrameOptions frame;
    std::uint32_t frames = 100;
    std::uint32_t warmup = 10;
    bool json = false;
};

// For people: one line per pass.
std::string tableText(const RunStats& stats)
{
    std::string text = fmt::format("{} ({})\n{}x{}, {} samples, {} of {} blades drawn\n",
                                   stats.device, stats.driver, stats.size.x, stats.size.y,
                                   stats.samples, stats.blades.drawn, stats.blades.total);
    text += fmt::format("{:<10}{:>12}{:>12}{:>12}\n", "[ms]", "min", "median", "p99");
    const auto line = [&text](const std::string& name, const gpu::Statistics& times) {
        text += fmt::format("{:<10}{:>12.4f}{:>12.4f}{:>12.4f}\n", name, times.min, times.median,
                            times.p99);
    };
    for (const auto& [name, times] : stats.gpuTimes)
        line(name, times);
    line("record", stats.recordTime);
    return text;
}

int bench(const BenchOptions& options)
{
    options.frame.log.apply();
    for (const std::string& field : options.frame.fields)
        if (field.ends_with(".json"))
            fail(ErrorKind::unsupported, "{}: scenes are not in this version; give a field", field);
    Headless headless(options.frame, false);

    // Warm up, forget, measure.
    {
        apps::ProgressBar bar(options.frame.log.showBar());
        Progress progress(bar.callback());
        progress.begin("frames", std::uint64_t(options.warmup) + options.frames);
        for (std::uint64_t frame = 0; frame < std::uint64_t(options.warmup) + options.frames;
             ++frame) {
            if (frame == options.warmup)
                headless.forgetTimes();
            headless.draw(frame);
            progress.advance(1);
        }
    }
    const RunStats stats = headless.stats();
    apps::writeResult(options.json ? statsText(stats) : tableText(stats));
    failOnValidationMessages(headless.instance());
    return 0;
}

} // namespace

void addBenchCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command = app.add_subcommand("bench", "Measure how long a field's frames take");
    const auto options = std::make_shared<BenchOptions>();
    command
        ->add_option("FILE", options->frame.fields,
                     "Fields as 'sward bake' wrote them, drawn together")
        ->type_name("")
        ->required();
    options->frame.addShared(*command);
    options->frame.addMeasured(*command);
    command->add_option("--frames", options->frames, "Frames that are measured [100]")
        ->type_name("N")
        ->check(CLI::Range(std::uint32_t(1), mostFrames));
    command->add_option("--warmup", options->warmup, "Frames before them that are not [10]")
        ->type_name("N")
        ->check(CLI::Range(std::uint32_t(0), mostFrames));
    command->add_flag("--json", options->json, "Print what 'render --stats' writes");
    options->frame.log.addBar(*command);
    command->footer("Example:\n  sward-view bench meadow.sward --camera eye --json");
    command->final_callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

} // namespace sward::view
