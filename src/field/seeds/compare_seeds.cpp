#include "field/seeds/compare_seeds.h"

#include "core/error.h"
#include "core/json/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace sward::field {
namespace {

constexpr double comparedCellSide = 32.0; // [m]

using WorldCell = std::array<double, 3>;

WorldCell worldCellOf(const PlacedSeeds& placed, std::size_t index)
{
    const SeedEntry& entry = placed.seeds->cells[index];
    WorldCell cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
        cell[axis] =
            placed.origin[glm::length_t(axis)] / comparedCellSide + double(entry.cell[axis]);
    return cell;
}

template <typename T>
bool haveSameBytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool areSame(const PlacedSeeds& first, std::size_t i, const PlacedSeeds& second, std::size_t j)
{
    const auto frameOf = [](const PlacedSeeds& placed, std::size_t index) {
        const SeedEntry& entry = placed.seeds->cells[index];
        return placed.seeds->data.subspan(entry.offset, entry.bytes);
    };
    const auto countsOf = [](const PlacedSeeds& placed, std::size_t index) {
        const SeedEntry& one = placed.seeds->cells[index];
        return std::array{one.vertices, one.pieces, one.clumps, one.conditions, one.words};
    };
    if (countsOf(first, i) != countsOf(second, j))
        return false;
    const auto a = frameOf(first, i);
    const auto b = frameOf(second, j);
    if (a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin()))
        return true;
    // Another version of the compressor may have packed the same numbers.
    const SeedCell x = readSeedCell(*first.seeds, i, "the first field");
    const SeedCell y = readSeedCell(*second.seeds, j, "the second field");
    return haveSameBytes(x.vertices, y.vertices) && haveSameBytes(x.pieces, y.pieces) &&
           haveSameBytes(x.clumps, y.clumps) && haveSameBytes(x.conditions, y.conditions) &&
           x.words == y.words;
}

} // namespace

std::string differencesOf(const SeedMeadow& first, const SeedMeadow& second)
{
    using nlohmann::json;
    const json a = json::parse(seedMeadowText(first));
    const json b = json::parse(seedMeadowText(second));
    std::string text;
    const auto add = [&](const std::string& name, const json& one, const json& other) {
        if (one != other)
            text += fmt::format("{}{} {} and {}", text.empty() ? "" : ", ", name, jsonText(one),
                                jsonText(other));
    };
    for (const auto& [key, value] : a.items()) {
        const json& other = b.at(key);
        if (key != "species" || value.size() != other.size()) {
            add(key == "species" ? "number of species" : key,
                key == "species" ? json(value.size()) : value,
                key == "species" ? json(other.size()) : other);
            continue;
        }
        for (std::size_t i = 0; i < value.size(); ++i)
            for (const auto& [trait, own] : value[i].items())
                add(fmt::format("species {}: {}", i, trait), own, other[i].at(trait));
    }
    return text;
}

SeedComparison compareSeeds(const PlacedSeeds& first, const PlacedSeeds& second)
{
    SeedComparison found;
    found.first = first.seeds == nullptr ? 0 : first.seeds->cells.size();
    found.second = second.seeds == nullptr ? 0 : second.seeds->cells.size();
    if ((first.seeds == nullptr) != (second.seeds == nullptr)) {
        found.onlyFirst = found.first;
        found.onlySecond = found.second;
        found.reasons.push_back(fmt::format("only the {} field has seeds",
                                            first.seeds != nullptr ? "first" : "second"));
    }
    if (first.seeds == nullptr || second.seeds == nullptr)
        return found;
    if (const std::string values = differencesOf(*first.seeds->meadow, *second.seeds->meadow);
        !values.empty())
        found.reasons.push_back(
            fmt::format("the meadows of the seeds differ, first and second: {}", values));
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < found.first && j < found.second) {
        const WorldCell left = worldCellOf(first, i);
        const WorldCell right = worldCellOf(second, j);
        if (left < right) {
            ++i;
            ++found.onlyFirst;
        } else if (right < left) {
            ++j;
            ++found.onlySecond;
        } else {
            found.differ += areSame(first, i++, second, j++) ? 0U : 1U;
        }
    }
    found.onlyFirst += found.first - i;
    found.onlySecond += found.second - j;
    if (found.onlyFirst + found.onlySecond > 0)
        found.reasons.push_back(
            fmt::format("{} cells of seeds are only in the first field, {} only in the second",
                        found.onlyFirst, found.onlySecond));
    if (found.differ > 0)
        found.reasons.push_back(fmt::format("{} cells of seeds differ", found.differ));
    return found;
}

} // namespace sward::field
