#include "apps/common/parse_text.h"
#include "apps/sward_view/bake_first.h"
#include "apps/sward_view/commands.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/viewer.h"
#include "core/error.h"
#include "core/log.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace sward::view {
namespace {

constexpr const char* footer =
    "In the window: left drag turns, middle or shift+left drag moves, the wheel comes nearer;\n"
    "F frames the field, Home returns, Space pauses the time, Escape closes.\n"
    "Example:\n"
    "  sward-view meadow.sward\n"
    "  sward-view landscape.glb";

struct WindowOptions {
    FrameOptions frame;
    double seconds = std::numeric_limits<double>::infinity();
};

int showWindow(const WindowOptions& options)
{
    const FrameOptions& frame = options.frame;
    frame.log.apply();
    if (frame.field.empty())
        fail(ErrorKind::usage, "no field or mesh is given\nRun 'sward-view --help' to see what it "
                               "takes.");

    if (frame.watch && frame.settingsFile.empty())
        fail(ErrorKind::usage, "--watch: there is no --settings to watch");

    // What is wrong with a file or the display is found out before anything long begins.
    const std::string name = std::filesystem::path(frame.field).filename().string();
    std::optional<field::MappedField> field;
    if (!wantsBaking(frame.field))
        field.emplace(field::readField(frame.field));
    Window window(frame.size, "Sward: " + name);
    if (!field)
        field.emplace(bakeFirst(frame.field));
    const field::FieldView view = field->view();
    log::info("{}: {} blades in {} patches", frame.field, view.blades.size(), view.patches.size());

    Viewer viewer(window, view, frame, name);
    viewer.run(options.seconds);
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
    app.add_option("FILE", options->frame.field,
                   "A field; or a mesh, on which grass is grown first by 'sward'")
        ->type_name("");
    options->frame.addShared(app);
    app.add_flag("--watch", options->frame.watch,
                 "Read the settings file again whenever it changes");
    app.add_option_function<std::string>(
           "--exit-after",
           [options](const std::string& text) {
               options->seconds = apps::parseNumber("--exit-after", text, 0, 1e9);
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
