// For builds without a window.
#include "apps/sward_view/commands.h"
#include "core/error.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace sward::view {

void addWindowCommand(CLI::App& app, apps::Command& chosen)
{
    const auto files = std::make_shared<std::vector<std::string>>();
    app.require_subcommand(0, 1);
    app.add_option("FILE", *files, "Field files; this build has no window to show them in")
        ->type_name("");
    app.footer(
        "This build has no window. 'sward-view render FILE -o PICTURE.png' draws a picture.");
    // The option writes to `files` as long as there are commands.
    app.final_callback([files, &app, &chosen] {
        if (app.get_subcommands().empty())
            chosen = []() -> int {
                fail(ErrorKind::unsupported, "this build has no window; 'sward-view render FILE -o "
                                             "PICTURE.png' draws a picture");
            };
    });
}

} // namespace sward::view
