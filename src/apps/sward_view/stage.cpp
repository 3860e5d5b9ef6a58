#include "apps/sward_view/stage.h"

#include <fmt/core.h>

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

} // namespace

std::vector<std::string> bakeArguments(const MeadowWishes& wishes)
{
    std::vector<std::string> arguments{wishes.ground};
    const auto add = [&arguments](const char* option, std::string value) {
        arguments.emplace_back(option);
        arguments.push_back(std::move(value));
    };
    add("--meadow", meadowNames[wishes.meadow]);
    if (wishes.amount == 1)
        add("--density", fmt::format("{:g}", wishes.density));
    if (wishes.amount == 2)
        add("--spacing", fmt::format("{:g}", wishes.spacing));
    if (wishes.amount == 3)
        add("--count", std::to_string(wishes.count));
    if (wishes.slopeLow > 0.0f || wishes.slopeHigh < 180.0f)
        add("--slope", fmt::format("{:g}:{:g}", wishes.slopeLow, wishes.slopeHigh));
    if (wishes.seed != 0)
        add("--seed", std::to_string(wishes.seed));
    addEach(arguments, "--mask", wishes.masks);
    addEach(arguments, "--set", wishes.traits);
    return arguments;
}

} // namespace sward::view
