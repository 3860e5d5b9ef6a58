#include "apps/common/parse_text.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/fields/baking.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/window/viewer.h"
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

constexpr const char* windowFooter =
    "In the window: left drag orbits, middle or Shift + left drag pans, the wheel\n"
    "zooms, right drag with W A S D Q E flies. F shows the whole field, Home returns\n"
    "to the first camera, Space pauses, H lists all keys, Escape closes the topmost\n"
    "item. A field, a mesh or a recipe that is dropped on the window is opened.\n"
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

    // Report a missing file before a window opens.
    for (const std::string& input : frame.fields)
        if (!wantsBaking(input) && !std::filesystem::exists(input))
            fail(ErrorKind::io, "{}: no such file", input);
    const std::string& meadow = options.viewer.meadow;
    if (!meadow.empty() && !std::filesystem::exists(meadow) &&
        std::ranges::none_of(meadowPresets,
                             [&](const MeadowPreset& preset) { return meadow == preset.name; }))
        fail(ErrorKind::usage, "--meadow: '{}' is not one of {}, nor a file", meadow,
             presetNames());
    const std::string name =
        frame.fields.empty() ? "" : std::filesystem::path(frame.fields[0]).filename().string();
    Window window(frame.size, options.viewer.fitsScreen, name.empty() ? "Sward" : "Sward: " + name);
    Viewer viewer(window, options.viewer);
    viewer.run();
    if (frame.validation)
        log::info("{} validation messages", viewer.instance().validationLog().count());
    failOnValidationMessages(viewer.instance());
    return 0;
}

// Rejects options before a command's name, which would be ignored.
void refuseLostOptions(const CLI::App& app)
{
    const std::string command = app.get_subcommands().front()->get_name();
    for (const CLI::Option* option : app.get_options())
        if (option->count() > 0 && option->get_envname().empty())
            fail(ErrorKind::usage, "{}: must stand after '{}'", option->get_name(), command);
}

} // namespace

void addWindowCommand(CLI::App& app, apps::Command& chosen)
{
    const auto options = std::make_shared<WindowOptions>();
    app.require_subcommand(0, 1);
    app.add_option("FILE", options->frame.fields,
                   "Field files, shown together; or grounds, which sward bakes first")
        ->type_name("");
    options->viewer.seconds = std::numeric_limits<double>::infinity();
    options->frame.addShared(app);
    const char* group = "Window";
    app.add_flag("--watch", options->frame.watch, "Reload files and settings when they change")
        ->group(group);
    app.add_option(
           "--meadow", options->viewer.meadow,
           "Meadow for grounds that are baked: meadow, grass, hay, lawn, daisies, alpine, marsh, "
           "prairie, steppe, dunes, or a .json file")
        ->type_name("NAME|FILE")
        ->group(group)
        ->default_str("meadow");
    app.add_option("--ground", options->viewer.ground,
                   "Ground on which the field was baked, for painting it and baking it again: a "
                   "mesh, a heightmap, a recipe, or the name of a built-in ground")
        ->type_name("FILE|NAME")
        ->group(group);
    app.add_option("--panel", options->viewer.panel,
                   "Panel that is open at the start: field, meadow, paint, physics, wind, culling, "
                   "colliders, look, camera, profile, capture; off: no panels, only the picture")
        ->type_name("NAME")
        ->group(group);
    app.add_option_function<std::string>(
           "--resolution",
           [options](const std::string& text) {
               if (text != "auto")
                   options->viewer.resolution = static_cast<float>(
                       apps::parseNumber("--resolution", text, InternalResolution::lowest, 1.0));
           },
           "Drawn pixels as a share of the window's width and height, 0.16 to 1; auto: fewer "
           "pixels while frames take long")
        ->type_name("auto|F")
        ->group(group)
        ->default_str("auto");
    app.add_option_function<std::string>(
           "--at-rest",
           [options](const std::string& text) {
               if (text != "refine" && text != "move")
                   fail(ErrorKind::usage, "--at-rest: '{}' is not refine or move", text);
               options->viewer.refinesAtRest = text == "refine";
           },
           "While nothing changes: refine stops time and refines one picture; move keeps drawing")
        ->type_name("refine|move")
        ->group(group)
        ->default_str("move, but refine on a CPU device with --resolution auto");
    app.add_option_function<std::string>(
           "--ui-scale",
           [options](const std::string& text) {
               if (text != "auto")
                   options->viewer.uiScale = static_cast<float>(
                       apps::parseNumber("--ui-scale", text, smallestUiScale, largestUiScale));
           },
           "Size of text and controls, 0.5 to 4, where 1 has text of 15 pixels; auto: the content "
           "scale of the desktop")
        ->type_name("auto|F")
        ->group(group)
        ->default_str("auto");
    group = "Tests";
    app.add_option("--controls", options->viewer.controlsFile,
                   "Write place and value of each control into this file, with each frame")
        ->type_name("FILE.json")
        ->group(group);
    app.add_option(
           "--shaders", options->viewer.shaderFolder,
           "For developers: the source tree's folder shaders, or a copy of it; compile what "
           "changes there and show it; none: watch none")
        ->type_name("DIR|none")
        ->group(group)
        ->default_str("none")
        ->envname("SWARD_SHADERS");
    app.add_option_function<std::string>(
           "--exit-after",
           [options](const std::string& text) {
               options->viewer.seconds = apps::parseNumber("--exit-after", text, 0, 1e9);
           },
           "Close the window after this time in seconds, 0 to 1 billion")
        ->type_name("S")
        ->group(group);
    app.footer(windowFooter);
    app.final_callback([options, &app, &chosen] {
        options->viewer.fitsScreen = app.get_option("--size")->count() == 0;
        if (app.get_subcommands().empty())
            chosen = [options] { return showWindow(*options); };
        else
            refuseLostOptions(app);
    });
}

} // namespace sward::view
