#include "apps/common/help_text.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace sward::apps {
namespace {

constexpr std::size_t columns = 80;
constexpr std::size_t textColumn = 28; ///< first column of descriptions

// Wraps `text` into lines that begin at `indent`, all but the first, and end before the last
// column.
std::string wrapped(const std::string& text, std::size_t indent)
{
    std::string result;
    std::size_t at = indent;
    for (const std::string& word : CLI::detail::split(text, ' ')) {
        if (word.empty())
            continue;
        if (at > indent && at + 1 + word.size() >= columns) {
            result += "\n" + std::string(indent, ' ');
            at = indent;
        } else if (at > indent) {
            result += ' ';
            ++at;
        }
        result += word;
        at += word.size();
    }
    return result + "\n";
}

// A name and its description, on one line if the name is short.
std::string entry(const std::string& name, const std::string& text)
{
    const std::string left = "  " + name;
    const std::string between = left.size() + 2 > textColumn
                                    ? "\n" + std::string(textColumn, ' ')
                                    : std::string(textColumn - left.size(), ' ');
    return left + between + wrapped(text, textColumn);
}

// "-o, --output OUT"
std::string nameAndValue(const CLI::Option& option)
{
    std::string names;
    for (const std::string& name : option.get_snames())
        names += (names.empty() ? "-" : ", -") + name;
    for (const std::string& name : option.get_lnames())
        names += (names.empty() ? "--" : ", --") + name;
    const std::string value = valueName(option);
    return names.empty() ? value : value.empty() ? names : names + " " + value;
}

bool isPositional(const CLI::Option* option)
{
    return option->get_positional() && option->get_lnames().empty() && option->get_snames().empty();
}

// Options without a group are hidden.
std::vector<const CLI::Option*> optionsIn(const CLI::App& app, const std::string& group)
{
    return app.get_options([&group](const CLI::Option* option) {
        return !group.empty() && !isPositional(option) && option->get_group() == group;
    });
}

std::string usageOf(const CLI::App& app, const std::string& name)
{
    std::string usage = "Usage: " + name;
    std::string positionals;
    for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
        if (isPositional(option))
            positionals +=
                option->get_required() ? " " + valueName(*option) : " [" + valueName(*option) + "]";
        else if (option->get_required())
            usage += (option->get_snames().empty() ? " --" + option->get_lnames().front()
                                                   : " -" + option->get_snames().front()) +
                     " " + valueName(*option);
    }
    const bool hasCommands = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
    return usage + " [OPTIONS]" + positionals + (hasCommands ? " [COMMAND]" : "") + "\n";
}

std::string groupText(const CLI::App& app, const std::string& group)
{
    std::string text;
    for (const CLI::Option* option : optionsIn(app, group))
        text += entry(nameAndValue(*option), describe(*option));
    // Newer versions of CLI11 call the default group "OPTIONS".
    return text.empty() ? text : "\n" + (group == "OPTIONS" ? "Options" : group) + ":\n" + text;
}

class HelpFormatter : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override
    {
        std::string text = wrapped(app->get_description(), 0) + "\n" + usageOf(*app, name);

        std::string positionals;
        for (const CLI::Option* option : app->get_options(isPositional))
            positionals += entry(valueName(*option), describe(*option));
        if (!positionals.empty())
            text += "\nArguments:\n" + positionals;

        // Print the group of --help last if it holds nothing else.
        const std::string general = app->get_help_ptr()->get_group();
        std::vector<std::string> groups = app->get_groups();
        const std::size_t always = app->get_version_ptr() == nullptr ? 1 : 2;
        if (optionsIn(*app, general).size() == always)
            std::stable_partition(groups.begin(), groups.end(),
                                  [&](const std::string& group) { return group != general; });
        for (const std::string& group : groups)
            text += groupText(*app, group);

        std::string commands;
        for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; }))
            commands += entry(command->get_name(), command->get_description());
        if (!commands.empty())
            text += "\nCommands:\n" + commands;
        const std::string footer = app->get_footer();
        return footer.empty() ? text : text + "\n" + footer + "\n";
    }
};

} // namespace

void useHelpText(CLI::App& app)
{
    app.formatter(std::make_shared<HelpFormatter>());
}

std::string valueName(const CLI::Option& option)
{
    if (!isPositional(&option) && option.get_items_expected_max() == 0)
        return {};
    const std::string name = isPositional(&option) ? option.get_name(true) : option.get_type_name();
    const bool takesMany = option.get_expected_max() >= CLI::detail::expected_max_vector_size &&
                           option.get_allow_extra_args();
    return takesMany ? name + "..." : name;
}

std::string describe(const CLI::Option& option)
{
    std::vector<std::string> facts;
    if (option.get_required())
        facts.emplace_back("required");
    if (!option.get_default_str().empty())
        facts.push_back("default: " + option.get_default_str());
    std::vector<std::string> others;
    for (const CLI::Option* other : option.get_excludes())
        if (!other->get_group().empty()) // former names are hidden
            others.push_back(other->get_name());
    std::sort(others.begin(), others.end());
    if (!others.empty())
        facts.push_back("not with " + CLI::detail::join(others, ", "));
    if (!option.get_envname().empty())
        facts.push_back("environment: " + option.get_envname());
    const std::string text = option.get_description();
    return facts.empty() ? text : text + " (" + CLI::detail::join(facts, "; ") + ")";
}

} // namespace sward::apps
