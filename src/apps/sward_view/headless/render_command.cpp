#include "apps/common/output.h"
#include "apps/common/parse_text.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/files/frame_names.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/blade_csv.h"
#include "apps/sward_view/headless/headless.h"
#include "apps/sward_view/headless/layered_drawing.h"
#include "apps/sward_view/picture/layer_files.h"
#include "apps/sward_view/picture/layer_list.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sward::view {
namespace {

constexpr std::uint64_t largestFrame = 10'000'000;

constexpr const char* footer =
    "Draws without a window, on a GPU, or on the CPU (package mesa-vulkan-drivers).\n"
    "Example:\n"
    "  sward-view render meadow.sward -o meadow.png --camera eye --size 1920x1080\n"
    "  sward-view render meadow.sward -o wind_%04d.png --frames 0:119\n"
    "  sward-view render meadow.sward -o m.exr --layers depth,normal,id --samples 1\n"
    "  sward-view render west.sward east.sward -o both.png";

struct RenderOptions {
    FrameOptions frame;
    std::string output;
    std::uint64_t firstFrame = 0;
    std::uint64_t lastFrame = 0;
    bool reference = false;
    std::string layerList;
    render::LayerMask layers = 0; ///< of layerList
    std::string stats;
    std::string dump;
    bool force = false;
};

// The files of a frame.
void addPaths(const RenderOptions& options, const FrameNames& names, std::uint64_t frame,
              std::vector<std::filesystem::path>& paths)
{
    const std::filesystem::path path = names.of(frame);
    paths.push_back(path);
    if (names.isExr() || names.isNpz())
        return;
    for (std::uint32_t i = 0; i < render::layerCount; ++i)
        if (const auto layer = static_cast<render::Layer>(i);
            (options.layers & render::bitOf(layer)) != 0)
            paths.push_back(layerPath(path, layer));
}

// Checks all outputs before the work.
void checkOutputs(const RenderOptions& options, const FrameNames& names)
{
    const std::vector<std::string>& fields = options.frame.fields;
    const auto require = [&](const std::string& path, const char* extension) {
        if (path.empty())
            return;
        for (const std::string& field : fields)
            if (std::error_code ignored; std::filesystem::equivalent(field, path, ignored))
                fail(ErrorKind::usage, "{}: is read and would be overwritten", path);
        apps::requireOutput(path, extension, options.force);
    };
    require(names.of(options.lastFrame).string(), names.extension());
    require(options.stats, ".json");
    require(options.dump, ".csv");

    // All pictures lie in one folder.
    std::vector<std::filesystem::path> paths;
    const std::uint64_t first = names.numbered() ? options.firstFrame : options.lastFrame;
    for (std::uint64_t frame = first; frame <= options.lastFrame; ++frame)
        addPaths(options, names, frame, paths);
    for (const std::filesystem::path& path : paths)
        refuseOverwrite(path, options.force);
    for (const std::string& path : {options.stats, options.dump})
        if (!path.empty())
            paths.emplace_back(path);
    std::sort(paths.begin(), paths.end());
    const auto twin = std::adjacent_find(paths.begin(), paths.end());
    if (twin != paths.end())
        fail(ErrorKind::usage, "{}: two outputs have the same name", twin->string());
}

/// Writes a picture, and its layers.
void writeFrame(const RenderOptions& options, const FrameNames& names, std::uint64_t frame,
                const LayeredFrame& drawn)
{
    const std::filesystem::path path = names.of(frame);
    if (names.isNpz())
        writeLayersNpz(drawn.radiance, drawn.layers, path, options.force);
    else if (names.isExr() && options.layers != 0)
        writeLayersExr(drawn.radiance, drawn.layers, apps::ExrCompression::zip, path,
                       options.force);
    else if (names.isExr())
        writeExr(drawn.radiance, path, options.force);
    else
        writePng(drawn.picture, path, options.force);
    if (!names.isExr() && !names.isNpz() && options.layers != 0)
        writeLayerPngs(drawn.layers, path, options.force);
}

/// Draws a reference picture and writes it.
void writeReference(const RenderOptions& options, const FrameNames& names, Headless& headless,
                    std::uint64_t frame)
{
    if (names.isExr())
        writeExr(headless.referenceRadiance(frame), names.of(frame), options.force);
    else
        writePng(headless.reference(frame), names.of(frame), options.force);
}

// Simulates up to the first frame, then draws and writes the requested outputs.
void drawFrames(const RenderOptions& options, const FrameNames& names, Headless& headless)
{
    apps::ProgressBar bar(options.frame.log.showBar());
    Progress progress(bar.callback());
    progress.begin("frames", options.lastFrame + 1);
    for (std::uint64_t frame = 0; frame < options.firstFrame; ++frame) {
        headless.skip(frame);
        progress.advance(1);
    }
    LayeredDrawing drawing(headless, options.layers, names.isExr() || names.isNpz(),
                           [&](std::uint64_t frame, const LayeredFrame& drawn) {
                               writeFrame(options, names, frame, drawn);
                           });
    for (std::uint64_t frame = options.firstFrame; frame <= options.lastFrame; ++frame) {
        const bool isWritten = names.numbered() || frame == options.lastFrame;
        if (options.reference && isWritten)
            writeReference(options, names, headless, frame);
        else
            drawing.draw(frame, isWritten);
        progress.advance(1);
    }
    drawing.finish();
}

int render(RenderOptions& options)
{
    options.frame.log.apply();
    if (!options.layerList.empty())
        options.layers = parseLayers("--layers", options.layerList);
    const FrameNames names(options.output, true, true);
    if (options.reference && (options.layers != 0 || names.isNpz()))
        fail(ErrorKind::usage, "--reference: the mean of many pictures has no layers, and is "
                               "written as .png or .exr");
    checkOutputs(options, names);
    const bool looksAhead = (options.layers & render::bitOf(render::Layer::flowForward)) != 0;
    Headless::requireTime(options.frame, options.lastFrame + (looksAhead ? 1 : 0));
    // Ids are unique only within one field; two fields of one mesh have equal ids.
    if (!options.dump.empty() && options.frame.fields.size() > 1)
        fail(ErrorKind::usage, "--dump-blades: {} fields are drawn; it writes the blades of one",
             options.frame.fields.size());

    if ((names.isExr() || names.isNpz()) && options.frame.debug != render::DebugMode::none)
        fail(ErrorKind::usage,
             "--debug: paints colours, and {} would hold radiance; write a .png of it",
             options.output);

    Headless headless(options.frame, {.blades = !options.dump.empty(),
                                      .radiance = names.isExr() || names.isNpz(),
                                      .layers = options.layers});
    checkOutputs(options, names); // against the files of settings, cameras and masks
    if (headless.isStreamed() && (options.reference || !options.dump.empty()))
        fail(ErrorKind::usage,
             "{}: needs all blades in device memory; --gpu-memory is too small for them",
             options.reference ? "--reference" : "--dump-blades");
    drawFrames(options, names, headless);
    const RunStats stats = headless.stats();
    log::info("{}: {}x{} pixels, {} of {} blades drawn on {}", names.of(options.lastFrame).string(),
              stats.size.x, stats.size.y, stats.blades.drawn, stats.blades.total, stats.device);

    if (!options.dump.empty())
        writeBladeCsv(headless.blades(), options.dump, options.force);
    if (!options.stats.empty())
        writeTextFile(options.stats, statsText(headless.stats()), options.force);
    failOnValidationMessages(headless.instance());
    return 0;
}

} // namespace

void addRenderCommand(CLI::App& app, apps::Command& chosen)
{
    CLI::App* command = app.add_subcommand("render", "Draw pictures of fields without a window");
    const auto options = std::make_shared<RenderOptions>();
    command->add_option("FILE", options->frame.fields, "Field files, drawn together")
        ->type_name("")
        ->required();
    command
        ->add_option(
            "-o,--output", options->output,
            "Picture to write: .png, or .exr with linear radiance as 16-bit R G B, before exposure "
            "and film curve, or .npz with the same as an array of NumPy; with %d or %04d in its "
            "name one for each frame")
        ->type_name("OUT")
        ->required();
    options->frame.addShared(*command);
    options->frame.addMeasured(*command);
    command
        ->add_option_function<std::string>(
            "--frames",
            [options](const std::string& text) {
                std::tie(options->firstFrame, options->lastFrame) =
                    apps::parseWholeRange("--frames", text, largestFrame);
            },
            "Frames to draw, 0 to 10 million; those before A are simulated only")
        ->type_name("A:B")
        ->default_str("0:0");
    command->add_flag("--reference", options->reference,
                      "Mean of 256 pictures of one state, without culling and level of detail");
    command
        ->add_option(
            "--layers", options->layerList,
            "Numbers of pixels to write besides, all or a list of " + layerNames() +
                ": parts of an .exr, arrays of an .npz, or beside a .png a .png of 16 bits "
                "for each (docs/layers.md)")
        ->type_name("LIST");
    command->add_option("--stats", options->stats, "JSON file for counts and times")
        ->type_name("FILE.json");
    command
        ->add_option("--dump-blades", options->dump,
                     "CSV file for the state of every blade of one field: of all stored ones, and "
                     "of those that are sown for this camera")
        ->type_name("FILE.csv");
    command->add_flag("--force", options->force, "Overwrite existing files");
    options->frame.log.addBar(*command);
    command->footer(footer);
    command->final_callback(
        [options, &chosen] { chosen = [options] { return render(*options); }; });
}

} // namespace sward::view
