#include "apps/common/parse_text.h"
#include "apps/sward_view/baking.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/viewer.h"
#include "core/error.h"
#include "core/log.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

namespace sward::view {
namespace {

constexpr const char* footer =
    "In the window: left drag turns, middle or shift+left drag moves, the wheel comes nearer, "
    "right\n"
    "drag with W A S D Q E flies; F frames the field, Home returns, Space pauses the time, H "
    "shows\n"
    "all keys, Escape closes. Drop a field, a mesh or a recipe on it to open it.\n"
    "Example:\n"
    "  sward-view meadow.sward\n"
    "  sward-view landscape.glb --meadow steppe --watch\n"
    "  sward-view west.sward east.sward\n"
    "  sward-view meadow.sward --settings storm.json --panel wind";

struct WindowOptions {
    FrameOptions frame;
    ViewerOptions viewer;
};

int showWindow(WindowOptions& options)
{
    const FrameOptions& frame = options.frame;
    frame.log.apply();
    options.viewer.frame = &frame;

    // A file that is not there is found out before a window opens.
    for (const std::string& input : frame.fields)
        if (!wantsBaking(input) && !std::filesystem::exists(input))
            fail(ErrorKind::io, "{}: no such file", input);
    const std::string& meadow = options.viewer.meadow;
    if (!meadow.empty() && !std::filesystem::exists(meadow) &&
        std::find(std::begin(meadowNames), std::end(meadowNames), meadow) == std::end(meadowNames))
        fail(ErrorKind::usage, "--meadow: '{}' is not one of {}, nor a file", meadow,
             fmt::join(meadowNames, ", "));
    const std::string name =
        frame.fields.empty() ? "" : std::filesystem::path(frame.fields[0]).filename().string();
    Window window(frame.size, name.empty() ? "Sward" : "Sward: " + name);
    Viewer viewer(window, options.viewer);
    viewer.run();
    if (frame.validation)
        log::info("{} validation messages", viewer.instance().validationLog().count());
    failOnValidationMessages(viewer.instance());
    return 0;
}

// An option before a command's name would be lost.
void refuseLostOptions(const CLI::App& app)
{
    const std::string command = app.get_subcommands().front()->get_name();
    for (const CLI::Option* option : app.get_options())
        if (option->count() > 0 && option->get_envname().empty())
            fail(ErrorKind::usage, "{}: belongs behind '{}'", option->get_name(), command);
}

} // namespace

void addWindowCommand(CLI::App& app, apps::Command& chosen)
{
    const auto options = std::make_shared<WindowOptions>();
    app.require_subcommand(0, 1);
    app.add_option("FILE", options->frame.fields,
                   "Fields, shown together; or meshes, on which grass is grown first by 'sward'")
        ->type_name("");
    options->viewer.seconds = std::numeric_limits<double>::infinity();
    options->frame.addShared(app);
    app.add_flag("--watch", options->frame.watch,
                 "Open the files, and read the settings, again whenever they change");
    app.add_option("--meadow", options->viewer.meadow,
                   "What is sown on a mesh: meadow, lawn, steppe, or a file of your own [meadow]")
        ->type_name("NAME|FILE");
    app.add_option("--panel", options->viewer.panel,
                   "Panel that is open at first: field, meadow, physics, wind, culling, colliders, "
                   "look, camera, profile, capture; off shows the picture alone")
        ->type_name("NAME");
    app.add_option_function<std::string>(
           "--resolution",
           [options](const std::string& text) {
               if (text != "auto")
                   options->viewer.resolution = static_cast<float>(
                       apps::parseNumber("--resolution", text, InternalResolution::lowest, 1.0));
           },
           "Share of the window's width and height that is drawn, 0.16 to 1; auto: fewer pixels "
           "when frames take long [auto]")
        ->type_name("auto|F");
    app.add_option("--controls", options->viewer.controlsFile,
                   "Tell where each control is and what it shows, a few times a second, for tests")
        ->type_name("JSON");
#ifdef SWARD_SHADER_FOLDER
    // The program may have gone elsewhere without its sources.
    if (std::filesystem::is_directory(SWARD_SHADER_FOLDER))
        options->viewer.shaderFolder = SWARD_SHADER_FOLDER;
    app.add_option("--shaders", options->viewer.shaderFolder,
                   "In this build: folder of shaders that are compiled and shown whenever they "
                   "change; none: watch none [the source tree's]")
        ->type_name("DIR|none")
        ->envname("SWARD_SHADERS");
#endif
    app.add_option_function<std::string>(
           "--exit-after",
           [options](const std::string& text) {
               options->viewer.seconds = apps::parseNumber("--exit-after", text, 0, 1e9);
           },
           "Close the window by itself, for tests")
        ->type_name("SECONDS");
    app.footer(footer);
    app.final_callback([options, &app, &chosen] {
        if (app.get_subcommands().empty())
            chosen = [options] { return showWindow(*options); };
        else
            refuseLostOptions(app);
    });
}

} // namespace sward::view
