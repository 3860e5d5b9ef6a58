#include "bake/settings/meadow.h"
#include "bake/settings/meadow_json.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace sward::bake {
namespace {

using nlohmann::json;

std::vector<std::string> stepsOf(const std::string& path)
{
    std::vector<std::string> steps(1);
    for (const char c : path)
        if (c == '.')
            steps.emplace_back();
        else
            steps.back() += c;
    return steps;
}

// A value as JSON, or else as text: outward, 0:30~5.
json valueOf(const std::string& assignment, const std::string& text)
{
    // A meadow's names go into the field file, which is JSON.
    if (!isUtf8(text))
        fail(ErrorKind::usage, "--set {}: the value is not UTF-8", assignment);
    if (text.starts_with("{") || text.starts_with("["))
        try {
            return parseJson(text, "--set " + assignment);
        } catch (const Error& error) {
            fail(ErrorKind::usage, "{}", error.what());
        }
    json value = json::parse(text, nullptr, false);
    return value.is_discarded() ? json(text) : value;
}

// Species selected by a path step: "*", a number, or a name.
std::vector<json*> speciesAt(json& list, const std::string& step, const std::string& assignment)
{
    std::vector<json*> found;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
        names.push_back(list[i]["name"].get<std::string>());
        if (step == "*" || step == names.back() || step == std::to_string(i))
            found.push_back(&list[i]);
    }
    if (found.empty())
        fail(ErrorKind::usage, "--set {}: no species \"{}\"; there are {}, numbers from 0, and *",
             assignment, step, fmt::join(names, ", "));
    return found;
}

void assign(json& object, const std::string& key, const json& value, const std::string& assignment)
{
    if (!object.contains(key) || key == "species") {
        std::vector<std::string> known;
        for (const auto& [name, ignored] : object.items())
            known.push_back(name);
        const std::string near = nearestWord(key, known);
        fail(ErrorKind::usage, "--set {}: no key \"{}\"{}; there are {}", assignment, key,
             near.empty() ? "" : fmt::format(", did you mean {}?", near), fmt::join(known, ", "));
    }
    object[key] = value;
}

} // namespace

Meadow withAssignments(const Meadow& meadow, const std::vector<std::string>& assignments)
{
    json object = meadowToJson(meadow);
    for (const std::string& assignment : assignments) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos)
            fail(ErrorKind::usage, "--set {}: expected key=value", assignment);
        std::vector<std::string> steps = stepsOf(assignment.substr(0, equals));
        const json value = valueOf(assignment, assignment.substr(equals + 1));
        if (steps.size() > 1 && steps.front() == "meadow")
            steps.erase(steps.begin());
        if (steps.size() == 1) {
            assign(object, steps[0], value, assignment);
        } else if (steps.size() == 3 && steps[0] == "species") {
            for (json* const species : speciesAt(object["species"], steps[1], assignment))
                assign(*species, steps[2], value, assignment);
        } else {
            fail(ErrorKind::usage, "--set {}: expected KEY=VALUE or species.NAME.KEY=VALUE",
                 assignment);
        }
        // Report errors of the reader as usage errors: the text comes from the command line.
        try {
            meadowFromJson(object, "--set " + assignment);
            if (steps.back() == "name")
                requireOwnNames(object, "--set " + assignment);
        } catch (const Error& error) {
            fail(ErrorKind::usage, "{}", error.what());
        }
    }
    return meadowFromJson(object, "--set");
}

} // namespace sward::bake
