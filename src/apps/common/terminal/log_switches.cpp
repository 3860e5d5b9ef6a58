#include "apps/common/terminal/log_switches.h"

#include "apps/common/terminal/terminal.h"
#include "core/log.h"

#include <CLI/CLI.hpp>

#include <string>

namespace sward::apps {

void LogSwitches::add(CLI::App& app)
{
    CLI::Option* quietOption =
        app.add_flag("-q,--quiet", quiet, "Print warnings and errors only")->group("Log");
    app.add_flag("-v,--verbose", verbose, "Print more about each step")
        ->group("Log")
        ->excludes(quietOption);
}

void LogSwitches::addBar(CLI::App& app)
{
    const auto choose = [this](const std::string& word) {
        bar = word == "always" ? Bar::always : word == "never" ? Bar::never : Bar::automatic;
    };
    app.add_option_function<std::string>("--progress", choose,
                                         "Progress bar on stderr; auto: on a terminal only")
        ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
        ->type_name("auto|always|never")
        ->default_str("auto")
        ->group("Log");
}

void LogSwitches::apply() const
{
    log::setLevel(quiet ? log::Level::warning : verbose ? log::Level::debug : log::Level::info);
}

bool LogSwitches::showBar() const
{
    if (bar == Bar::automatic)
        return !quiet && stderrIsTerminal();
    return bar == Bar::always;
}

} // namespace sward::apps
