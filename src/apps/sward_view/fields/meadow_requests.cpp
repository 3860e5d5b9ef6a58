#include "apps/sward_view/fields/meadow_requests.h"

#include "apps/sward_view/fields/meadow_species.h"

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

// A number of untrusted field data; none if it is invalid.
std::optional<double> numberIn(const nlohmann::json& json, const char* key)
{
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? std::optional(found->get<double>())
                                                     : std::nullopt;
}

void readAmount(const nlohmann::json& settings, MeadowRequests& requests)
{
    if (const auto density = numberIn(settings, "density")) {
        requests.amount = 1;
        requests.density = static_cast<float>(*density);
    } else if (const auto spacing = numberIn(settings, "spacing")) {
        requests.amount = 2;
        requests.spacing = static_cast<float>(*spacing);
    } else if (const auto count = numberIn(settings, "count");
               count && *count >= 1.0 && *count < 2e9) {
        requests.amount = 3;
        requests.count = static_cast<int>(*count);
    }
}

void readSlope(const nlohmann::json& settings, MeadowRequests& requests)
{
    const auto found = settings.find("slope");
    if (found == settings.end() || !found->is_array() || found->size() != 3)
        return;
    for (const auto& end : *found)
        if (!end.is_number())
            return;
    requests.slopeLow = std::clamp((*found)[0].get<float>(), 0.0f, 180.0f);
    requests.slopeHigh = std::clamp((*found)[1].get<float>(), 0.0f, 180.0f);
    requests.slopeSoft = std::clamp((*found)[2].get<float>(), 0.0f, 180.0f);
}

} // namespace

MeadowRequests requestsOf(const std::string& provenance)
{
    MeadowRequests requests;
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    const auto settings = json.is_object() ? json.find("settings") : json.end();
    if (settings == json.end() || !settings->is_object())
        return requests;
    readAmount(*settings, requests);
    readSlope(*settings, requests);
    if (const auto seed = numberIn(*settings, "seed"); seed && *seed >= 0.0 && *seed < 1e9)
        requests.seed = static_cast<int>(*seed);

    const auto masks = settings->find("masks");
    if (masks != settings->end() && masks->is_array())
        for (const auto& mask : *masks) {
            const std::string text = mask.is_string() ? mask.get<std::string>() : std::string();
            // A field holds only the hash of a mask image, not the image.
            if (!text.empty() && !text.starts_with("texture:"))
                requests.masks += (requests.masks.empty() ? "" : " ") + text;
        }
    // The ground's colours choose no mask for a field that was baked without one.
    if (masks != settings->end() && masks->is_array() && masks->empty())
        requests.masks = "none";
    const auto meadow = settings->find("meadow");
    if (meadow != settings->end() && meadow->is_object())
        for (std::size_t i = 0; i < std::size(meadowPresets); ++i)
            if (meadow->value("name", nlohmann::json()) == meadowPresets[i].name)
                requests.meadow = static_cast<int>(i);
    return requests;
}

std::vector<std::string> unstoredArguments(const MeadowRequests& requests)
{
    std::vector<std::string> arguments;
    if (!requests.meadowFile.empty()) {
        arguments = {"--meadow", requests.meadowFile};
        addEach(arguments, "--set", requests.traits);
    }
    addEach(arguments, "--mask", requests.masks);
    return arguments;
}

std::vector<std::string> bakeArguments(const MeadowRequests& requests)
{
    std::vector<std::string> arguments{requests.ground};
    const auto add = [&arguments](const char* option, std::string value) {
        arguments.emplace_back(option);
        arguments.push_back(std::move(value));
    };
    add("--meadow",
        requests.meadowFile.empty() ? meadowPresets[requests.meadow].name : requests.meadowFile);
    if (requests.amount == 1)
        add("--density", fmt::format("{:g}", requests.density));
    if (requests.amount == 2)
        add("--spacing", fmt::format("{:g}", requests.spacing));
    if (requests.amount == 3)
        add("--count", std::to_string(requests.count));
    if (requests.slopeLow > 0.0f || requests.slopeHigh < 180.0f)
        add("--slope",
            fmt::format("{:g}:{:g}", requests.slopeLow, requests.slopeHigh) +
                (requests.slopeSoft > 0.0f ? fmt::format("~{:g}", requests.slopeSoft) : ""));
    if (requests.seed != 0)
        add("--seed", std::to_string(requests.seed));
    addEach(arguments, "--mask", requests.masks);
    addEach(arguments, "--set", requests.traits);
    return arguments;
}

} // namespace sward::view
