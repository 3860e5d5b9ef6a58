#include "apps/sward/text/provenance_text.h"

#include "bake/mask/soft_range.h"
#include "core/json/json_text.h"

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
constexpr std::size_t abreast = 3; ///< species or organs per table

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
    return key.ends_with("_m") ? " m" : key.ends_with("_deg") ? " degrees" : "";
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
    for (const std::string_view unit : {"_m", "_deg"})
        if (key.ends_with(unit))
            key.resize(key.size() - unit.size());
    std::ranges::replace(key, '_', ' ');
    return key;
}

std::string row(std::size_t indent, const std::string& key, const std::string& value)
{
    return fmt::format("{}{:<{}}{}\n", std::string(indent, ' '), nameText(key),
                       nameColumns - indent, value);
}

bool isTable(const json& list)
{
    return list.is_array() && !list.empty() &&
           std::ranges::all_of(list, [](const json& one) { return one.is_object(); });
}

// A cell of a table. Masks and organs are listed below it.
std::string cellText(const json& one, const std::string& key)
{
    if (!one.contains(key))
        return "";
    const json& value = one.at(key);
    if ((key != "mask" && key != "organs") || value.empty() || value == "")
        return valueText(key, value);
    return fmt::format("{} below", value.is_array() ? value.size() : 1);
}

// Table with keys as rows, and species or organs as columns.
std::string tableText(const json& list)
{
    std::string text;
    for (std::size_t first = 0; first < list.size(); first += abreast) {
        const std::size_t beyond = std::min(first + abreast, list.size());
        std::vector<std::string> keys{"name"};
        for (std::size_t i = first; i < beyond; ++i)
            for (const auto& [key, value] : list[i].items())
                if (std::ranges::find(keys, key) == keys.end())
                    keys.push_back(key);
        for (const std::string& key : keys) {
            std::string line = fmt::format("    {:<{}}", nameText(key), nameColumns);
            for (std::size_t i = first; i < beyond; ++i)
                line += fmt::format("{:<{}}  ", cellText(list[i], key), speciesColumns);
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        }
    }
    return text;
}

// The species, followed by the masks and organs of each.
std::string speciesText(const json& species)
{
    std::string text = "  species of the meadow\n" + tableText(species);
    for (const json& one : species) {
        const std::string name = valueText("name", one.value("name", json()));
        json masks = one.value("mask", json::array());
        if (!masks.is_array())
            masks = masks == "" ? json::array() : json::array({masks});
        if (!masks.empty())
            text += fmt::format("  masks of {}\n", name);
        for (const json& mask : masks)
            text += fmt::format("    {}\n", valueText("mask", mask));
        if (const json organs = one.value("organs", json::array()); isTable(organs))
            text += fmt::format("  organs of {}\n", name) + tableText(organs);
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
    return isTable(species) ? text + speciesText(species) : text;
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
