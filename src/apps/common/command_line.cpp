#include "apps/common/command_line.h"

#include "apps/common/command_pages.h"
#include "apps/common/help_text.h"
#include "apps/common/output.h"
#include "apps/common/version.h"
#include "core/error.h"
#include "core/json/settings_json.h"
#include "core/system/arguments.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace sward::apps {
namespace {

// The innermost command on the command line.
const CLI::App& chosenApp(const CLI::App& app)
{
    const CLI::App* chosen = &app;
    while (!chosen->get_subcommands().empty())
        chosen = chosen->get_subcommands().front();
    return *chosen;
}

// "sward bake", for messages.
std::string nameOf(const CLI::App& app)
{
    const CLI::App* parent = app.get_parent();
    return parent == nullptr ? app.get_name() : nameOf(*parent) + " " + app.get_name();
}

std::vector<std::string> knownWords(const CLI::App& app)
{
    std::vector<std::string> words;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            words.push_back("--" + name);
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        words.push_back(command->get_name());
    return words;
}

// Proposes a known word for the first unexpected argument.
std::string proposal(const CLI::App& app)
{
    for (const std::string& argument : app.remaining(true)) {
        const std::string word = argument.substr(0, argument.find('='));
        const std::string near = nearestWord(word, knownWords(app));
        if (!near.empty() && near != word)
            return "; did you mean " + near + "?";
    }
    return {};
}

// Ends the parsing by an exception with a page; CLI11 prints it like a version, with a newline
// after it.
[[noreturn]] void answer(std::string page)
{
    if (page.ends_with('\n'))
        page.pop_back();
    throw CLI::CallForVersion(page, 0);
}

} // namespace

void prepareApp(CLI::App& app, const std::string& program)
{
    app.name(program);
    // A path may begin with a slash, on Windows too.
    app.allow_windows_style_options(false);
    app.set_version_flag("--version", versionText(program), "Print the version and exit");
    app.set_help_flag("-h,--help", "Print this help and exit");
    useHelpText(app);
    // Handled like the version. In no group, so that --help does not list them.
    app.add_flag_callback(
           "--man", [&app, program] { answer(manualPage(app, program)); },
           "Print the manual page and exit")
        ->group("");
    app.add_flag_callback(
           "--completion", [&app, program] { answer(bashCompletion(app, program)); },
           "Print a completion script for bash and exit")
        ->group("");
}

std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv)
{
    // CLI11 takes the last one first, without the program's name.
    std::vector<std::string> arguments = programArguments(argc, argv);
    if (!arguments.empty())
        arguments.erase(arguments.begin());
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(std::move(arguments));
        return std::nullopt;
    } catch (const CLI::Success& wanted) {
        // CLI11 throws help and version as exceptions and prints their texts.
        std::ostringstream out;
        std::ostringstream err;
        app.exit(wanted, out, err);
        writeResult(out.str());
        return 0;
    } catch (const CLI::ParseError& refused) {
        const CLI::App& chosen = chosenApp(app);
        const bool unexpected =
            refused.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
        fail(ErrorKind::usage, "{}{}\n'{} --help' lists what is accepted.", refused.what(),
             unexpected ? proposal(chosen) : "", nameOf(chosen));
    }
}

} // namespace sward::apps
