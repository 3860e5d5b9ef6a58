#include "apps/sward_view/meadow_wishes.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

namespace sward::view {
namespace {

void addEach(std::vector<std::string>& arguments, const char* option, const std::string& words)
{
    std::istringstream in(words);
    for (std::string word; in >> word;) {
        arguments.emplace_back(option);
        arguments.push_back(word);
    }
}

// A number of a field that anybody may have written; nothing if it is none.
std::optional<double> numberIn(const nlohmann::json& json, const char* key)
{
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? std::optional(found->get<double>())
                                                     : std::nullopt;
}

void readAmount(const nlohmann::json& settings, MeadowWishes& wishes)
{
    if (const auto density = numberIn(settings, "density")) {
        wishes.amount = 1;
        wishes.density = static_cast<float>(*density);
    } else if (const auto spacing = numberIn(settings, "spacing")) {
        wishes.amount = 2;
        wishes.spacing = static_cast<float>(*spacing);
    } else if (const auto count = numberIn(settings, "count");
               count && *count >= 1.0 && *count < 2e9) {
        wishes.amount = 3;
        wishes.count = static_cast<int>(*count);
    }
}

void readSlope(const nlohmann::json& settings, MeadowWishes& wishes)
{
    const auto found = settings.find("slope");
    if (found == settings.end() || !found->is_array() || found->size() != 3)
        return;
    for (const auto& end : *found)
        if (!end.is_number())
            return;
    wishes.slopeLow = std::clamp((*found)[0].get<float>(), 0.0f, 180.0f);
    wishes.slopeHigh = std::clamp((*found)[1].get<float>(), 0.0f, 180.0f);
    wishes.slopeSoft = std::clamp((*found)[2].get<float>(), 0.0f, 180.0f);
}

} // namespace

MeadowWishes wishesOf(const std::string& provenance)
{
    MeadowWishes wishes;
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    const auto settings = json.is_object() ? json.find("settings") : json.end();
    if (settings == json.end() || !settings->is_object())
        return wishes;
    readAmount(*settings, wishes);
    readSlope(*settings, wishes);
    if (const auto seed = numberIn(*settings, "seed"); seed && *seed >= 0.0 && *seed < 1e9)
        wishes.seed = static_cast<int>(*seed);

    const auto masks = settings->find("masks");
    if (masks != settings->end() && masks->is_array())
        for (const auto& mask : *masks) {
            const std::string text = mask.is_string() ? mask.get<std::string>() : std::string();
            // Of an image there is no more than a number that tells it from others.
            if (!text.empty() && !text.starts_with("texture:"))
                wishes.masks += (wishes.masks.empty() ? "" : " ") + text;
        }
    const auto meadow = settings->find("meadow");
    if (meadow != settings->end() && meadow->is_object())
        for (std::size_t i = 0; i < std::size(meadowNames); ++i)
            if (meadow->value("name", nlohmann::json()) == meadowNames[i])
                wishes.meadow = static_cast<int>(i);
    return wishes;
}

std::vector<std::string> bakeArguments(const MeadowWishes& wishes)
{
    std::vector<std::string> arguments{wishes.ground};
    const auto add = [&arguments](const char* option, std::string value) {
        arguments.emplace_back(option);
        arguments.push_back(std::move(value));
    };
    add("--meadow", wishes.meadowFile.empty() ? meadowNames[wishes.meadow] : wishes.meadowFile);
    if (wishes.amount == 1)
        add("--density", fmt::format("{:g}", wishes.density));
    if (wishes.amount == 2)
        add("--spacing", fmt::format("{:g}", wishes.spacing));
    if (wishes.amount == 3)
        add("--count", std::to_string(wishes.count));
    if (wishes.slopeLow > 0.0f || wishes.slopeHigh < 180.0f)
        add("--slope", fmt::format("{:g}:{:g}", wishes.slopeLow, wishes.slopeHigh) +
                           (wishes.slopeSoft > 0.0f ? fmt::format("~{:g}", wishes.slopeSoft) : ""));
    if (wishes.seed != 0)
        add("--seed", std::to_string(wishes.seed));
    addEach(arguments, "--mask", wishes.masks);
    addEach(arguments, "--set", wishes.traits);
    return arguments;
}

} // namespace sward::view
