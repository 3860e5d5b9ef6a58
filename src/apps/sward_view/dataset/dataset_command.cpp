#include "apps/common/field_input.h"
#include "apps/common/output.h"
#include "apps/common/parse_text.h"
#include "apps/common/temporary_folder.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/dataset/bake_draws.h"
#include "apps/sward_view/dataset/dataset_files.h"
#include "apps/sward_view/dataset/set_drawing.h"
#include "apps/sward_view/dataset/work_queue.h"
#include "apps/sward_view/graphics.h"
#include "core/error.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "core/system/freed_memory.h"
#include "field/read.h"
#include "gpu/device/device.h"
#include "gpu/device/instance.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

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
    double seconds = 0.0;    ///< of drawing and writing
    std::atomic<std::uint64_t> bytes = 0;
    std::atomic<double> writing = 0.0; ///< [s] of all threads together
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

/// The picture and the layers of a frame, out of the memory of its place, which they leave.
LayeredFrame taken(const SetDrawing& drawing, const DatasetScene& scene, bool isRadiance,
                   SetDrawing::Submitted submitted)
{
    LayeredFrame drawn;
    drawn.layers = drawing.layersOf(submitted);
    if (isRadiance) {
        drawn.radiance.size = scene.size;
        drawn.radiance.rgba.resize(submitted.picture.size() / sizeof(std::uint16_t));
        std::memcpy(drawn.radiance.rgba.data(), submitted.picture.data(), submitted.picture.size());
    } else {
        const auto* first = reinterpret_cast<const std::uint8_t*>(submitted.picture.data());
        drawn.picture = {scene.size, {first, first + submitted.picture.size()}};
    }
    return drawn;
}

/// Draws the frames of one field: the device draws one while the CPU prepares the next one, and
/// while threads take the ones before out of its memory and write them.
void drawFramesOf(SetDrawing& drawing, const FrameDraws& draws, bool isRadiance,
                  const DatasetScene& scene, DatasetFiles* files,
                  std::span<const std::uint64_t> frames, WorkQueue& queue, Progress& progress,
                  Done& done)
{
    struct InFlight {
        std::uint64_t frame;
        std::shared_ptr<const DrawnFrame> what;
        SetDrawing::Submitted submitted;
    };
    std::deque<InFlight> inFlight;
    const auto handOver = [&] {
        InFlight first = std::move(inFlight.front());
        inFlight.pop_front();
        drawing.wait(first.submitted);
        done.deviceTime += drawing.takeDeviceTime();
        ++done.frames;
        if (files == nullptr) {
            progress.advance(1);
            return;
        }
        queue.add([&drawing, &scene, &progress, &done, isRadiance, files,
                   first = std::make_shared<InFlight>(std::move(first))] {
            Stopwatch watch;
            LayeredFrame drawn = taken(drawing, scene, isRadiance, std::move(first->submitted));
            done.bytes += files->write(first->frame, *first->what, std::move(drawn));
            done.writing += watch.lap();
            progress.advance(1);
        });
    };
    for (const std::uint64_t frame : frames) {
        const auto what = std::make_shared<const DrawnFrame>(draws.draw(frame));
        inFlight.push_back({frame, what, drawing.submit(*what)});
        if (inFlight.size() > 1)
            handOver();
    }
    while (!inFlight.empty())
        handOver();
    // What writes refers to this field.
    queue.finish();
    drawing.finish();
    done.deviceTime += drawing.takeDeviceTime();
}

std::string datasetSummary(const DatasetOptions& options, const Done& done)
{
    if (done.frames == 0)
        return fmt::format("{}: nothing is left to draw\n", options.folder);
    const double frames = double(done.frames);
    const double seconds = std::max(done.seconds, 1e-9);
    std::string text = fmt::format("{} frames: {:.1f} frames per second on the device", done.frames,
                                   1e3 * frames / std::max(done.deviceTime, 1e-9));
    text += options.nullOutput
                ? fmt::format(", {:.1f} drawn\n", frames / seconds)
                : fmt::format(", {:.1f} written, {:.1f} MB and {:.0f} ms of a thread each\n",
                              frames / seconds, 1e-6 * double(done.bytes) / frames,
                              1e3 * done.writing / frames);
    return text;
}

/// The frames of the share that are not finished, by field.
std::vector<std::vector<std::uint64_t>>
framesLeft(const DatasetScene& scene, const DatasetOptions& options, DatasetFiles* files)
{
    std::vector<std::vector<std::uint64_t>> left(scene.fields.size());
    for (std::uint64_t frame = options.share.number - 1; frame < scene.frames;
         frame += options.share.of)
        if (files == nullptr || !files->isFinished(frame))
            left[fieldOfFrame(scene, frame)].push_back(frame);
    return left;
}

/// Draws the frames that are left, field after field, on one device.
void drawAll(const DatasetScene& scene, const DatasetOptions& options,
             std::span<const field::FieldView> fields, DatasetFiles* output,
             std::span<const std::vector<std::uint64_t>> left, Progress& progress, Done& done)
{
    const bool isRadiance = scene.format != DatasetFormat::png;
    const std::uint32_t threads =
        options.threads > 0 ? options.threads : std::max(std::thread::hardware_concurrency(), 1U);
    const gpu::Instance instance = createInstance(options.validation);
    const gpu::Device device(instance, {.selection = options.device});
    for (std::size_t field = 0; field < left.size(); ++field) {
        if (left[field].empty())
            continue;
        const FrameOptions frame = frameOptionsOf(scene, options, field);
        SetDrawing drawing(device, scene, frame, fields[field], isRadiance, threads);
        const FrameDraws draws(scene, fields[field], drawing.settings());
        // Ranges that the ground does not meet leave no manifest, which would claim the folder.
        static_cast<void>(draws.draw(left[field].front()));
        if (output != nullptr)
            output->writeManifest(device.context().name + " (" + device.context().driver + ")");
        // Ends before what its tasks use.
        WorkQueue queue(threads);
        Stopwatch watch;
        drawFramesOf(drawing, draws, isRadiance, scene, output, left[field], queue, progress, done);
        done.seconds += watch.lap();
        failOnValidationMessages(instance);
    }
}

/// Bakes what the scene asks for into `folder`/fields, unless it is there, and adds it to the
/// scene's fields.
std::vector<DrawnBake> bakeFor(DatasetScene& scene, const DatasetOptions& options,
                               const fs::path& folder)
{
    std::vector<DrawnBake> bakes = drawBakes(scene.bakes, scene.seed, scene.file.parent_path());
    if (bakes.empty())
        return bakes;
    if (scene.fields.size() + bakes.size() > render::LayerId::maxFields)
        fail(ErrorKind::input, "{}: {} fields, and {} bakes; expected {} at most together",
             scene.file.string(), scene.fields.size(), bakes.size(), render::LayerId::maxFields);
    const fs::path fields = folder / "fields";
    const std::size_t first =
        std::size_t(options.share.number - 1) * bakes.size() / options.share.of;
    bakeMissing(bakes, fields, first, scene.file.string(), options.log.showBar());
    for (const DrawnBake& bake : bakes)
        scene.fields.push_back((fields / bake.file).string());
    return bakes;
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
    DatasetScene scene = readDatasetScene(options.scene);
    if (!options.nullOutput)
        DatasetFiles::requireScene(scene, options.folder);
    // Without output its fields go with this folder.
    std::optional<apps::TemporaryFolder> temporary;
    if (options.nullOutput && scene.bakes.count > 0)
        temporary.emplace("sward-view");
    const std::vector<DrawnBake> bakes =
        bakeFor(scene, options, temporary ? temporary->path() : fs::path(options.folder));
    std::vector<field::MappedField> stored;
    std::vector<field::FieldView> views;
    for (const std::string& name : scene.fields) {
        apps::requireField(name);
        views.push_back(stored.emplace_back(field::readField(name)).view());
    }
    std::optional<DatasetFiles> files;
    if (!options.nullOutput)
        files.emplace(scene, views, bakes, options.folder);
    DatasetFiles* const output = files ? &*files : nullptr;

    const auto left = framesLeft(scene, options, output);
    std::uint64_t count = 0;
    for (const std::vector<std::uint64_t>& frames : left)
        count += frames.size();
    apps::ProgressBar bar(options.log.showBar());
    Progress progress(bar.callback());
    progress.begin("frames", count);
    Done done;
    if (count > 0)
        drawAll(scene, options, views, output, left, progress, done);
    if (output != nullptr && output->isComplete())
        output->writeObjects();
    bar.clear();
    apps::writeResult(datasetSummary(options, done));
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
