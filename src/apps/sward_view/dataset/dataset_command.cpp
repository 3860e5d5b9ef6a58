#include "apps/common/output.h"
#include "apps/common/parse_text.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/dataset/dataset_files.h"
#include "apps/sward_view/dataset/work_queue.h"
#include "apps/sward_view/graphics.h"
#include "core/error.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "core/system/freed_memory.h"
#include "field/read.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sward::view {
namespace {

constexpr std::uint32_t maxShares = 100'000;
constexpr std::uint32_t maxThreads = 1024;

constexpr const char* datasetFooter =
    "Each frame depends on the scene and its number alone: any number of processes\n"
    "draw a set, each its share, and a run that was stopped goes on where it was.\n"
    "Example:\n"
    "  sward-view dataset set.json -o set\n"
    "  sward-view dataset set.json -o set --share 2/4\n"
    "  sward-view dataset set.json --null-output";

/// A part of the frames: every `of`-th one.
struct Share {
    std::uint32_t number = 1; ///< 1 to `of`
    std::uint32_t of = 1;
};

struct DatasetOptions {
    std::string scene;
    std::string folder;
    Share share;
    std::uint32_t threads = 0; ///< 0: as many as there are cores
    bool nullOutput = false;
    std::string device;
    bool validation = false;
    apps::LogSwitches log;
};

Share parseShare(const std::string& text)
{
    Share share;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, share.number);
    const bool hasSlash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = hasSlash ? std::from_chars(first.ptr + 1, end, share.of) : first;
    if (!hasSlash || second.ec != std::errc() || second.ptr != end || share.number < 1 ||
        share.number > share.of || share.of > maxShares)
        fail(ErrorKind::usage,
             "--share: '{}' is not I/N, such as 2/4, with I from 1 to N and N up to {}", text,
             maxShares);
    return share;
}

/// What a run has done.
struct Done {
    std::uint64_t frames = 0;
    double deviceTime = 0.0; ///< [ms]
    std::atomic<std::uint64_t> bytes = 0;
};

FrameOptions frameOptionsOf(const DatasetScene& scene, const DatasetOptions& options,
                            std::size_t field)
{
    FrameOptions frame;
    frame.fields = {scene.fields[field]};
    frame.size = scene.size;
    frame.samples = scene.samples;
    frame.geometry = render::Geometry::raster;
    frame.settingsFile = scene.settings;
    frame.device = options.device;
    frame.validation = options.validation;
    frame.sownMemory = 0; // what is sown depends on the frames before
    return frame;
}

/// Draws a frame without a past, and takes its layers.
LayeredFrame drawOne(Headless& headless, const DatasetScene& scene, const DrawnFrame& what,
                     render::LayerMask layers, bool isRadiance, render::LayerWords& words,
                     render::LayerWords& next)
{
    headless.forgetMotion();
    for (std::uint32_t i = scene.settling; i > 0; --i)
        headless.move(what.settings, what.time - double(i) * scene.step);
    headless.draw({what.camera, what.before, what.settings, what.time}, layers);
    LayeredFrame drawn;
    if (layers != 0)
        words = headless.layerWords();
    if (isRadiance)
        drawn.radiance = headless.radiance();
    else
        drawn.picture = headless.picture();
    constexpr render::LayerMask ahead = render::bitOf(render::Layer::flowForward);
    if ((layers & ahead) != 0) {
        headless.draw({what.next, what.camera, what.settings, what.time + scene.step}, ahead);
        next = headless.layerWords();
    }
    return drawn;
}

/// Draws the frames of one field.
void drawFramesOf(Headless& headless, const DatasetScene& scene, const DatasetFiles* files,
                  std::span<const std::uint64_t> frames, WorkQueue& queue, Progress& progress,
                  Done& done)
{
    const bool isRadiance = scene.format != DatasetFormat::png;
    const render::LayerMask layers = scene.layers | layersForObjects(scene);
    render::FrameSettings settings = headless.settings();
    settings.leavesThinned = true;
    const FrameDraws draws(scene, headless.field(), settings);
    for (const std::uint64_t frame : frames) {
        const auto what = std::make_shared<const DrawnFrame>(draws.draw(frame));
        const auto words = std::make_shared<render::LayerWords>();
        const auto next = std::make_shared<render::LayerWords>();
        const auto drawn = std::make_shared<LayeredFrame>(
            drawOne(headless, scene, *what, layers, isRadiance, *words, *next));
        done.deviceTime += headless.takeDeviceTime();
        ++done.frames;
        if (files == nullptr) {
            progress.advance(1);
            continue;
        }
        queue.add([&headless, &progress, &done, files, frame, what, words, next, drawn] {
            constexpr auto forward = static_cast<std::size_t>(render::Layer::flowForward);
            if (words->wanted != 0)
                drawn->layers = headless.layersOf(*words);
            if (next->wanted != 0)
                drawn->layers.arrays[forward] = headless.layersOf(*next).arrays[forward];
            done.bytes += files->write(frame, *what, std::move(*drawn));
            progress.advance(1);
        });
    }
    // What writes refers to this field.
    queue.finish();
}

std::string datasetSummary(const DatasetOptions& options, const Done& done, double seconds)
{
    if (done.frames == 0)
        return fmt::format("{}: nothing is left to draw\n", options.folder);
    const double frames = double(done.frames);
    std::string text = fmt::format("{} frames: {:.1f} frames per second on the device", done.frames,
                                   1e3 * frames / std::max(done.deviceTime, 1e-9));
    text += options.nullOutput ? fmt::format(", {:.1f} drawn\n", frames / seconds)
                               : fmt::format(", {:.1f} written, {:.1f} MB each\n", frames / seconds,
                                             1e-6 * double(done.bytes) / frames);
    return text;
}

/// The frames of the share that are not finished, by field.
std::vector<std::vector<std::uint64_t>>
framesLeft(const DatasetScene& scene, const DatasetOptions& options, const DatasetFiles* files)
{
    std::vector<std::vector<std::uint64_t>> left(scene.fields.size());
    for (std::uint64_t frame = options.share.number - 1; frame < scene.frames;
         frame += options.share.of)
        if (files == nullptr || !files->isFinished(frame))
            left[fieldOfFrame(scene, frame)].push_back(frame);
    return left;
}

int makeDataset(const DatasetOptions& options)
{
    options.log.apply();
    // Every frame makes the same arrays of many megabytes.
    keepFreedMemory();
    if (options.nullOutput && !options.folder.empty())
        fail(ErrorKind::usage, "--null-output: writes nothing, so not with -o");
    if (!options.nullOutput && options.folder.empty())
        fail(ErrorKind::usage, "-o is missing: the folder of the set");
    const DatasetScene scene = readDatasetScene(options.scene);
    std::vector<field::MappedField> stored;
    std::vector<field::FieldView> views;
    for (const std::string& name : scene.fields)
        views.push_back(stored.emplace_back(field::readField(name)).view());
    std::optional<DatasetFiles> files;
    if (!options.nullOutput)
        files.emplace(scene, views, options.folder);
    const DatasetFiles* const output = files ? &*files : nullptr;

    const auto left = framesLeft(scene, options, output);
    std::uint64_t count = 0;
    for (const std::vector<std::uint64_t>& frames : left)
        count += frames.size();
    apps::ProgressBar bar(options.log.showBar());
    Progress progress(bar.callback());
    progress.begin("frames", count);
    Done done;
    double seconds = 0.0;
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    for (std::size_t field = 0; field < left.size(); ++field) {
        if (left[field].empty())
            continue;
        const FrameOptions frame = frameOptionsOf(scene, options, field);
        Headless headless(frame, {.radiance = scene.format != DatasetFormat::png,
                                  .layers = scene.layers | layersForObjects(scene)});
        if (output != nullptr)
            output->writeManifest(headless.deviceName());
        // Ends before what its tasks use.
        WorkQueue queue(options.threads > 0 ? options.threads : cores);
        Stopwatch watch;
        drawFramesOf(headless, scene, output, left[field], queue, progress, done);
        seconds += watch.lap();
        failOnValidationMessages(headless.instance());
    }
    if (output != nullptr && output->isComplete())
        output->writeObjects();
    bar.clear();
    apps::writeResult(datasetSummary(options, done, std::max(seconds, 1e-9)));
    return 0;
}

} // namespace

void addDatasetCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command = app.add_subcommand(
        "dataset", "Draw a set of pictures with layers, cameras and masks of plants");
    const auto options = std::make_shared<DatasetOptions>();
    command->add_option("SCENE", options->scene, "What to draw (.json, keys: docs/layers.md)")
        ->type_name("")
        ->required();
    command
        ->add_option("-o,--output", options->folder,
                     "Folder of the set; finished frames in it are kept")
        ->type_name("DIR");
    command
        ->add_option_function<std::string>(
            "--share", [options](const std::string& text) { options->share = parseShare(text); },
            "Draw only every N-th frame, from the I-th on: a share for each of N processes")
        ->type_name("I/N")
        ->default_str("1/1");
    command->add_option("--threads", options->threads, "Threads that write files, 1 to 1024")
        ->type_name("N")
        ->check(CLI::Range(1U, maxThreads).description(""))
        ->default_str("one for each core");
    command->add_flag("--null-output", options->nullOutput,
                      "Write nothing: only measure how many frames are drawn per second");
    command
        ->add_option("--device", options->device,
                     "Vulkan device, by the number or a part of the name that 'sward-view devices' "
                     "lists")
        ->type_name("N|NAME")
        ->default_str("the best")
        ->envname("SWARD_DEVICE");
    command->add_flag("--validation", options->validation,
                      "Run under the Vulkan validation layer; any message is a failure");
    options->log.add(*command);
    options->log.addBar(*command);
    command->footer(datasetFooter);
    command->final_callback(
        [options, &chosen] { chosen = [options] { return makeDataset(*options); }; });
}

} // namespace sward::view
