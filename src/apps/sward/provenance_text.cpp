#include "apps/sward/provenance_text.h"

#include "bake/filter/soft_range.h"
#include "core/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::apps {
namespace {

using nlohmann::json;

constexpr std::size_t nameColumns = 22;
constexpr std::size_t speciesColumns = 20;
constexpr std::size_t speciesAbreast = 3; ///< species per table

// Settings of three numbers, low, high and the width of the fade, with their units.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> ranges{{{"slope", "degrees"},
                                                                               {"altitude", "m"},
                                                                               {"curvature", "1/m"},
                                                                               {"border", "m"},
                                                                               {"above_water", "m"},
                                                                               {"sky", ""}}};

// Units of single numbers whose keys do not end in them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> units{
    {{"density", "1/m2"},
     {"spacing", "m"},
     {"clearance", "m"},
     {"ray_length", "m"},
     {"min_island", "m2"}}};

bool isUnlimited(double number)
{
    return !(std::abs(number) < bake::unbounded);
}

std::string numberText(const json& value)
{
    if (!value.is_number_float())
        return jsonText(value);
    const double number = value.get<double>();
    return isUnlimited(number) ? "unlimited" : fmt::format("{:.6g}", number);
}

std::string rangeText(double low, double high, double soft, std::string_view unit)
{
    const std::string of = unit.empty() ? "" : fmt::format(" {}", unit);
    std::string text;
    if (isUnlimited(low) && isUnlimited(high))
        return "unlimited";
    if (isUnlimited(high))
        text = fmt::format("at least {:.6g}{}", low, of);
    else if (isUnlimited(low))
        text = fmt::format("at most {:.6g}{}", high, of);
    else
        text = fmt::format("{:.6g} to {:.6g}{}", low, high, of);
    return soft > 0.0 ? text + fmt::format(", fading over {:.6g}{}", soft, of) : text;
}

bool isVector(const json& value)
{
    return value.is_array() && value.size() == 3 &&
           std::ranges::all_of(value, [](const json& entry) { return entry.is_number(); });
}

std::string unitOf(std::string_view key)
{
    for (const auto& [name, unit] : units)
        if (key == name)
            return fmt::format(" {}", unit);
    return key.ends_with("_m") ? " m" : "";
}

std::string valueText(std::string_view key, const json& value);

std::string listText(std::string_view key, const json& list)
{
    std::string text;
    for (const json& entry : list)
        text += (text.empty() ? "" : ", ") + valueText(key, entry);
    return text.empty() ? "none" : text;
}

// "radial from 0, 0, 0", "pond.glb 2 m …": the values of a small object.
std::string objectText(const json& object)
{
    if (object.contains("centre"))
        return "radial from " + listText("", object.at("centre"));
    std::string text;
    for (const auto& [key, value] : object.items())
        text += (text.empty() ? "" : ", ") + key + " " + valueText(key, value);
    return text.empty() ? "none" : text;
}

std::string valueText(std::string_view key, const json& value)
{
    if (value.is_null())
        return "none";
    if (value.is_boolean())
        return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        return text.empty() ? "none" : text == ":" ? "unlimited" : text;
    }
    if (value.is_object())
        return objectText(value);
    if (!value.is_array())
        return numberText(value) + unitOf(key);
    for (const auto& [name, unit] : ranges)
        if (key == name && isVector(value))
            return rangeText(value[0].get<double>(), value[1].get<double>(), value[2].get<double>(),
                             unit);
    // Two numbers are a range; others stay a list.
    if (value.size() == 2 && value[0].is_number() && value[1].is_number())
        return numberText(value[0]) + " to " + numberText(value[1]) + unitOf(key);
    return listText(key, value);
}

// "clump_size_m" as "clump size".
std::string nameText(std::string key)
{
    if (key.ends_with("_m"))
        key.resize(key.size() - 2);
    std::ranges::replace(key, '_', ' ');
    return key;
}

std::string row(std::size_t indent, const std::string& key, const std::string& value)
{
    return fmt::format("{}{:<{}}{}\n", std::string(indent, ' '), nameText(key),
                       nameColumns - indent, value);
}

// Table with keys as rows and species as columns.
std::string speciesText(const json& species)
{
    std::string text;
    for (std::size_t first = 0; first < species.size(); first += speciesAbreast) {
        const std::size_t beyond = std::min(first + speciesAbreast, species.size());
        std::vector<std::string> keys{"name"};
        for (const auto& [key, value] : species[first].items())
            if (key != "name")
                keys.push_back(key);
        for (const std::string& key : keys) {
            std::string line = fmt::format("    {:<{}}", nameText(key), nameColumns);
            for (std::size_t i = first; i < beyond; ++i)
                line += fmt::format(
                    "{:<{}}  ", species[i].contains(key) ? valueText(key, species[i].at(key)) : "",
                    speciesColumns);
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        }
    }
    return text;
}

// Settings, followed by those of the meadow and its species.
std::string settingsText(const json& settings)
{
    std::string text;
    for (const auto& [key, value] : settings.items())
        if (key != "meadow")
            text += row(4, key, valueText(key, value));
    if (!settings.contains("meadow") || !settings.at("meadow").is_object())
        return text;
    const json& meadow = settings.at("meadow");
    text += "  meadow\n";
    for (const auto& [key, value] : meadow.items())
        if (key != "species")
            text += row(4, key, valueText(key, value));
    const json& species = meadow.value("species", json::array());
    const bool isTable = species.is_array() &&
                         std::ranges::all_of(species, [](const json& s) { return s.is_object(); });
    return isTable && !species.empty() ? text + "  species of the meadow\n" + speciesText(species)
                                       : text;
}

} // namespace

std::string provenanceText(const std::string& provenance)
{
    const json all = json::parse(provenance, nullptr, false);
    if (!all.is_object())
        return row(2, "provenance", provenance.empty() ? "none" : provenance);
    std::string text;
    if (all.contains("tool"))
        text += row(2, "baked by", valueText("tool", all.at("tool")));
    for (const auto& [key, value] : all.items())
        if (key != "settings" && key != "tool")
            text += row(2, key, valueText(key, value));
    if (all.contains("settings") && all.at("settings").is_object())
        text += "  settings\n" + settingsText(all.at("settings"));
    return text;
}

} // namespace sward::apps
