#include "apps/sward/options/bake_arguments.h"

#include "core/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace sward::apps {
namespace {

// Options that do not affect the result: how the bake runs and where its output goes.
constexpr std::array<std::string_view, 13> aboutTheRun = {
    "--output",       "--threads",    "--report",         "--dry-run",  "--force",
    "--print-config", "--quiet",      "--verbose",        "--progress", "--tiles",
    "--help",         "--paint-mask", "--paint-mask-size"};

} // namespace

std::vector<std::string> bakeArguments(const CLI::App& app)
{
    std::vector<std::string> arguments;
    std::vector<std::string> inputs;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0)
            continue;
        std::string name =
            option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames()[0];
        if (name == formerSkyRays)
            name = "--sky-rays";
        if (std::find(aboutTheRun.begin(), aboutTheRun.end(), name) != aboutTheRun.end())
            continue;
        const std::vector<std::string>& values = option->results();
        if (option->get_positional()) {
            inputs.insert(inputs.end(), values.begin(), values.end());
        } else if (option->get_type_size() == 0) {
            arguments.push_back(name);
        } else if (option->get_type_size() > 1) {
            arguments.push_back(name);
            arguments.insert(arguments.end(), values.begin(), values.end());
        } else {
            for (const std::string& value : values)
                arguments.push_back(name + "=" + value);
        }
    }
    arguments.push_back("--");
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    return arguments;
}

BakeRequest requestOf(const std::vector<std::string>& arguments, const std::string& place)
{
    CLI::App app;
    BakeOptions options;
    options.add(app);
    // CLI11 expects reversed order. Missing required options are allowed here.
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    reversed.emplace_back("--output=unused");
    try {
        app.parse(reversed);
    } catch (const CLI::ParseError& error) {
        fail(ErrorKind::input, "{}: {}", place, error.what());
    }
    return options.request();
}

} // namespace sward::apps
