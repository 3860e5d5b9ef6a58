#include "apps/common/command_pages.h"

#include "apps/common/help_text.h"
#include "apps/common/version.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <regex>
#include <vector>

namespace sward::apps {
namespace {

constexpr const char* exitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\nDone.\n"
    ".TP\n.B 1\nWrong usage: an option, a setting, or a name.\n"
    ".TP\n.B 2\nA file cannot be read or written, or would be overwritten.\n"
    ".TP\n.B 3\nA file was read, but its content is not valid.\n"
    ".TP\n.B 4\nFailure while running: the device was lost, or there is no display or memory.\n"
    ".TP\n.B 5\nNot supported: a format, a version, or no Vulkan device.\n"
    ".TP\n.B 7\nA comparison found a difference.\n"
    ".TP\n.B 130\nInterrupted.\n";

// Escapes text for roff: backslashes and leading dots are special.
std::string roff(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
            result += std::string("\\&") + c;
        else
            result += c;
    }
    return result;
}

// The programs' pages, and where the documentation lies once it is installed.
std::string seeAlso(const std::string& program)
{
    const std::string other = program == "sward" ? "sward-view" : "sward";
    return fmt::format(
        ".SH SEE ALSO\n.BR {} (1)\n.PP\n"
        "The folder share/doc/sward of the installation (package sward\\-doc): tutorial,\n"
        "troubleshooting, cookbook, meadow files, settings files, exports, engine.\n",
        roff(other));
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app)
{
    return app.get_subcommands(
        [](const CLI::App* command) { return !command->get_name().empty(); });
}

// The options that --help shows.
std::vector<const CLI::Option*> optionsOf(const CLI::App& app)
{
    return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> namesOf(const CLI::Option& option)
{
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

bool takesValue(const CLI::Option& option)
{
    return option.get_items_expected_max() != 0;
}

std::string optionText(const CLI::Option& option)
{
    std::string names;
    if (option.get_positional())
        names = "\\fI" + roff(valueName(option)) + "\\fR";
    for (const std::string& name : namesOf(option))
        names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    const std::string value = valueName(option);
    if (!option.get_positional() && !value.empty())
        names += " \\fI" + roff(value) + "\\fR";
    return ".TP\n" + names + "\n" + roff(describe(option)) + "\n";
}

// Arguments first, then the options by their groups, as in --help.
std::string optionsText(const CLI::App& app)
{
    const std::vector<const CLI::Option*> options = optionsOf(app);
    std::string text;
    for (const CLI::Option* option : options)
        if (option->get_positional())
            text += optionText(*option);
    const std::string general = app.get_help_ptr()->get_group();
    for (const std::string& group : app.get_groups()) {
        std::string entries;
        for (const CLI::Option* option : options)
            if (!option->get_positional() && option->get_group() == group)
                entries += optionText(*option);
        const bool hasTitle = group != general && !entries.empty();
        text += hasTitle ? fmt::format(".PP\n.B {}:\n{}", roff(group), entries) : entries;
    }
    return text;
}

// Keeps the lines of a footer.
std::string footerText(const CLI::App& app)
{
    const std::string footer = app.get_footer();
    return footer.empty() ? "" : ".PP\n.nf\n" + roff(footer) + "\n.fi\n";
}

// Words listed in a type or a description as a|b|c or {a,b,c}.
std::vector<std::string> wordsOf(const CLI::Option& option)
{
    std::vector<std::string> words;
    const std::string text = option.get_type_name() + " " + option.get_description();
    static const std::regex choice(R"(\b[a-z0-9-]+(\|[a-z0-9-]+)+\b|\{[a-z0-9-]+(,[a-z0-9-]+)+\})");
    std::smatch found;
    if (!std::regex_search(text, found, choice))
        return words;
    static const std::regex word("[a-z0-9-]+");
    const std::string all = found.str();
    for (auto it = std::sregex_iterator(all.begin(), all.end(), word); it != std::sregex_iterator();
         ++it)
        words.push_back(it->str());
    return words;
}

// Variables that set options, and one for all output.
std::string environmentText(const CLI::App& app)
{
    std::map<std::string, std::string> found;
    std::vector<const CLI::App*> apps = commandsOf(app);
    apps.push_back(&app);
    for (const CLI::App* command : apps)
        for (const CLI::Option* option : optionsOf(*command))
            if (!option->get_envname().empty())
                found[option->get_envname()] = option->get_name();
    std::string text = ".SH ENVIRONMENT\n"
                       ".TP\n.B NO_COLOR\nIf set, output has no colours, not even on a terminal.\n";
    for (const auto& [variable, option] : found)
        text += fmt::format(".TP\n.B {}\nThe value of {} where that is not given.\n",
                            roff(variable), roff(option));
    return text;
}

std::string joined(const std::vector<std::string>& words, const char* between)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

// The words that may follow an app's name, and those that may follow its options.
std::string completionCase(const CLI::App& app, const std::string& name)
{
    std::vector<std::string> options;
    std::string values;
    for (const CLI::Option* option : optionsOf(app)) {
        const std::vector<std::string> names = namesOf(*option);
        options.insert(options.end(), names.begin(), names.end());
        if (!takesValue(*option) || names.empty())
            continue;
        const std::string pattern = joined(names, "|");
        const std::vector<std::string> words = wordsOf(*option);
        values += words.empty()
                      ? fmt::format("        '{}':{}) compopt -o default; return ;;\n", name,
                                    joined(names, fmt::format("|'{}':", name).c_str()))
                      : fmt::format("        '{}':{}) words='{}' ;;\n", name,
                                    joined(names, fmt::format("|'{}':", name).c_str()),
                                    joined(words, " "));
    }
    return values + fmt::format("        '{}':*) words='{}' ;;\n", name, joined(options, " "));
}

} // namespace

std::string manualPage(const CLI::App& app, const std::string& program)
{
    std::string upper = program;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::string about = app.get_description();
    std::string text = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", roff(upper),
                                   roff(versionText(program)));
    text += fmt::format(".SH NAME\n{} \\- {}\n", roff(program),
                        roff(about.substr(0, about.find_first_of(".\n"))));
    text += fmt::format(".SH SYNOPSIS\n.B {}\n[\\fICOMMAND\\fR] [\\fIOPTIONS\\fR] ...\n",
                        roff(program));
    text += ".SH DESCRIPTION\n" + roff(about) + "\n" + footerText(app);
    text += ".SH OPTIONS\n" + optionsText(app);
    if (!commandsOf(app).empty())
        text += ".SH COMMANDS\n";
    for (const CLI::App* command : commandsOf(app)) {
        text += fmt::format(".SS {}\n{}\n", roff(program + " " + command->get_name()),
                            roff(command->get_description()));
        text += optionsText(*command) + footerText(*command);
    }
    return text + exitStatus + environmentText(app) + seeAlso(program);
}

std::string bashCompletion(const CLI::App& app, const std::string& program)
{
    std::string function = "_" + program;
    std::replace(function.begin(), function.end(), '-', '_');
    std::vector<std::string> names;
    for (const CLI::App* command : commandsOf(app))
        names.push_back(command->get_name());

    std::string text =
        fmt::format("# Completes {} in bash. Written by '{} --completion'.\n", program, program);
    text += function + "() {\n";
    text += "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
            "    local command='' words='' i\n"
            "    for ((i = 1; i < COMP_CWORD; ++i)); do\n";
    text += names.empty()
                ? "        :\n"
                : fmt::format("        case ${{COMP_WORDS[i]}} in {}) command=${{COMP_WORDS[i]}}; "
                              "break ;; esac\n",
                              joined(names, "|"));
    text += "    done\n"
            "    case $command:$before in\n";
    text += completionCase(app, "");
    for (const CLI::App* command : commandsOf(app))
        text += completionCase(*command, command->get_name());
    text += "    esac\n";
    if (!names.empty())
        text += fmt::format("    [[ -z $command ]] && words+=' {}'\n", joined(names, " "));
    text += "    [[ $word != -* ]] && compopt -o default\n"
            "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
            "}\n";
    return text + fmt::format("complete -F {} {}\n", function, program);
}

} // namespace sward::apps
