#include "apps/sward_view/dataset/bake_draws.h"

#include "apps/common/interrupt.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/common/version.h"
#include "apps/sward_view/fields/baking.h"
#include "core/error.h"
#include "core/files/file_hash.h"
#include "core/json/settings_json.h"
#include "core/log.h"
#include "core/random.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string_view>
#include <thread>

namespace sward::view {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Options that the set itself decides on.
constexpr std::array<std::string_view, 16> ownOptions{
    "o", "output", "force",   "report",   "dry-run",    "print-config",    "threads",
    "q", "quiet",  "verbose", "progress", "paint-mask", "paint-mask-size", "help",
    "v", "h"};

/// Options whose numbers are whole.
constexpr std::array<std::string_view, 6> wholeOptions{"seed",       "count",    "budget",
                                                       "max-blades", "sky-rays", "scene"};

/// Seeds of bakes that state none: as large as `seed` of a scene.
constexpr glm::dvec2 usualSeeds(0.0, 2e9);

constexpr std::size_t maxWords = 10'000; ///< of a setting
constexpr double maxNumber = 1e15;

template <typename Names>
bool isAmong(const Names& names, std::string_view name)
{
    return std::ranges::find(names, name) != names.end();
}

/// Whether numbers of a setting are whole: of some options, and how many leaves a plant has.
bool isWholeSetting(std::string_view name)
{
    return isAmong(wholeOptions, name) || (name.starts_with("set ") && name.ends_with(".count"));
}

/// Throws unless a number can be drawn from a range. `place` names its key.
void requireDrawable(glm::dvec2 range, bool isWhole, const std::string& place)
{
    if (range.x > range.y)
        fail(ErrorKind::input, "{}: {} is above {}", place, range.x, range.y);
    if (isWhole && range.x == range.y && range.x != std::floor(range.x))
        fail(ErrorKind::input, "{}: {} is not a whole number", place, range.x);
    if (isWhole && std::ceil(range.x) > std::floor(range.y))
        fail(ErrorKind::input, "{}: no whole number is from {} to {}", place, range.x, range.y);
}

/// A "{LOW..HIGH}" in a text.
struct BraceRange {
    glm::dvec2 range;
    std::size_t end; ///< in the text, one past it
};

/// The range that begins at a place of a text; none if its braces say anything else.
std::optional<BraceRange> rangeAt(std::string_view word, std::size_t at)
{
    const std::size_t end = word.find('}', at);
    const std::size_t dots = word.find("..", at);
    if (word[at] != '{' || end == std::string_view::npos || dots > end)
        return std::nullopt;
    glm::dvec2 range(0.0);
    const auto low = std::from_chars(word.data() + at + 1, word.data() + dots, range.x);
    const auto high = std::from_chars(word.data() + dots + 2, word.data() + end, range.y);
    if (low.ec != std::errc() || low.ptr != word.data() + dots || high.ec != std::errc() ||
        high.ptr != word.data() + end)
        return std::nullopt;
    return BraceRange{range, end + 1};
}

double numberOf(const json& value, const std::string& place)
{
    const double number = value.get<double>();
    if (!std::isfinite(number) || std::abs(number) > maxNumber)
        fail(ErrorKind::input, "{}: {} is beyond {:.0e}", place, number, maxNumber);
    return number;
}

/// Reads a value: a number, its range, a text, texts, texts with weights, or true.
BakeSetting readSetting(std::string name, const json& value, const std::string& place)
{
    BakeSetting setting{.name = std::move(name)};
    const bool isWhole = isWholeSetting(setting.name);
    const auto addWord = [&](const json& word, double weight) {
        if (!word.is_string())
            fail(ErrorKind::input, "{}: expected texts, found {}", place, word.type_name());
        const std::string& text = word.get_ref<const std::string&>();
        for (std::size_t at = 0; at < text.size(); ++at)
            if (const std::optional<BraceRange> found = rangeAt(text, at))
                requireDrawable(found->range, isWhole, place);
        setting.words.push_back(text);
        setting.weights.push_back(weight);
    };
    if (value.is_boolean()) {
        setting.isFlag = value.get<bool>();
    } else if (value.is_number()) {
        setting.range = glm::dvec2(numberOf(value, place));
    } else if (value.is_string()) {
        addWord(value, 1.0);
    } else if (value.is_array() && value.size() == 2 && value[0].is_number() &&
               value[1].is_number()) {
        setting.range = {numberOf(value[0], place), numberOf(value[1], place)};
    } else if (value.is_array() && !value.empty() && value.size() <= maxWords) {
        for (const json& word : value)
            addWord(word, 1.0);
    } else if (value.is_object() && !value.empty() && value.size() <= maxWords) {
        for (const auto& [word, weight] : value.items()) {
            if (!weight.is_number() || numberOf(weight, place) < 0.0)
                fail(ErrorKind::input, "{}: the weight of \"{}\" is no number from 0 on", place,
                     word);
            addWord(word, weight.get<double>());
        }
        if (std::accumulate(setting.weights.begin(), setting.weights.end(), 0.0) <= 0.0)
            fail(ErrorKind::input, "{}: no weight is above 0", place);
    } else {
        fail(ErrorKind::input,
             "{}: expected a number, [LOW, HIGH], a text, an array of texts, or an object of texts "
             "and their weights",
             place);
    }
    if (setting.range)
        requireDrawable(*setting.range, isWhole, place);
    return setting;
}

/// The random numbers of a bake. Each setting has its own, so that another one changes none.
class BakeNumbers {
public:
    BakeNumbers(std::uint64_t seed, std::size_t bake)
        : key_(hashBits(seed, 0x62616b65)) // a stream of its own, beside that of frames
        , bake_(bake)
    {
    }

    /// Goes on with the numbers of a setting.
    void of(std::string_view name)
    {
        std::uint64_t hash = name.size();
        for (const char c : name)
            hash = hashBits(hash, static_cast<unsigned char>(c));
        dimension_ = static_cast<std::uint32_t>(hash);
    }

    double next() { return uniform(key_, bake_, dimension_++); } ///< [0, 1)

    /// A number as text: what is stated to its last digit, what is drawn to six, within the range.
    std::string between(glm::dvec2 range, bool isWhole)
    {
        if (isWhole)
            return fmt::format(
                "{:.0f}", std::floor(std::ceil(range.x) +
                                     next() * (std::floor(range.y) - std::ceil(range.x) + 1.0)));
        if (range.x == range.y)
            return fmt::format("{}", range.x);
        const double drawn = range.x + next() * (range.y - range.x);
        std::string text = fmt::format("{:.6g}", drawn);
        double rounded = 0.0;
        std::from_chars(text.data(), text.data() + text.size(), rounded);
        return range.x <= rounded && rounded <= range.y ? text : fmt::format("{}", drawn);
    }

private:
    std::uint64_t key_;
    std::uint64_t bake_;
    std::uint32_t dimension_ = 0;
};

/// Replaces each "{LOW..HIGH}"; other braces stay.
std::string filledIn(std::string_view word, bool isWhole, BakeNumbers& numbers)
{
    std::string text;
    for (std::size_t at = 0; at < word.size();) {
        if (const std::optional<BraceRange> found = rangeAt(word, at)) {
            text += numbers.between(found->range, isWhole);
            at = found->end;
        } else {
            text += word[at++];
        }
    }
    return text;
}

std::string valueOf(const BakeSetting& setting, BakeNumbers& numbers)
{
    numbers.of(setting.name);
    const bool isWhole = isWholeSetting(setting.name);
    if (setting.range)
        return numbers.between(*setting.range, isWhole);
    const double sum = std::accumulate(setting.weights.begin(), setting.weights.end(), 0.0);
    double left = numbers.next() * sum;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < setting.words.size(); ++i) {
        if (setting.weights[i] <= 0.0)
            continue;
        chosen = i;
        left -= setting.weights[i];
        if (left < 0.0)
            break;
    }
    return filledIn(setting.words[chosen], isWhole, numbers);
}

/// Finds files of the scene's folder in a value: the whole, or what stands between colons.
class FoundFiles {
public:
    explicit FoundFiles(const fs::path& folder)
        : folder_(folder)
    {
    }

    std::string found(const std::string& value)
    {
        if (isFile(value))
            return pathOf(value);
        std::string text;
        for (std::size_t at = 0; at <= value.size();) {
            const std::size_t end = std::min(value.find(':', at), value.size());
            const std::string part = value.substr(at, end - at);
            text += isFile(part) ? pathOf(part) : part;
            if (end < value.size())
                text += ':';
            at = end + 1;
        }
        return text;
    }

    /// Hashes of all files found.
    const std::string& hashes() const { return hashes_; }

private:
    bool isFile(const std::string& name) const
    {
        std::error_code error;
        return !name.empty() && fs::is_regular_file(folder_ / name, error);
    }
    std::string pathOf(const std::string& name)
    {
        const fs::path path = (folder_ / name).lexically_normal();
        hashes_ += hashOfFile(path);
        return path.string();
    }

    fs::path folder_;
    std::string hashes_;
};

DrawnBake drawBake(const BakeRanges& ranges, std::uint64_t seed, const fs::path& folder,
                   std::size_t number)
{
    BakeNumbers numbers(seed, number);
    FoundFiles files(folder);
    DrawnBake bake;
    const auto add = [&](const std::string& value) {
        bake.shown.push_back(value);
        bake.arguments.push_back(files.found(value));
    };
    add(valueOf(ranges.ground, numbers));
    for (const BakeSetting& setting : ranges.settings) {
        constexpr std::string_view set = "set ";
        if (setting.isFlag) {
            add("--" + setting.name);
        } else if (setting.name.starts_with(set)) {
            add("--set");
            add(setting.name.substr(set.size()) + "=" + valueOf(setting, numbers));
        } else {
            // One argument: a value may begin with a minus.
            const std::string value = valueOf(setting, numbers);
            bake.shown.push_back("--" + setting.name + "=" + value);
            bake.arguments.push_back("--" + setting.name + "=" + files.found(value));
        }
    }
    std::uint64_t hash = 0;
    std::string text = apps::versionText("sward") + files.hashes();
    for (const std::string& argument : bake.shown)
        text += '\n' + argument;
    for (const char c : text)
        hash = hashBits(hash, static_cast<unsigned char>(c));
    bake.file = fmt::format("field_{:04}_{:016x}.sward", number, hash);
    return bake;
}

void bakeOne(const DrawnBake& bake, const fs::path& file, const std::string& scene, bool showBar)
{
    log::info("{}: baking {}: sward bake {}", scene, file.string(),
              fmt::join(bake.shown.begin(), bake.shown.end(), " "));
    Baking baking(bake.arguments, file);
    {
        apps::ProgressBar bar(showBar);
        const Progress::Callback show = bar.callback();
        while (!baking.poll()) {
            if (apps::interruptRequested())
                baking.cancel();
            if (show)
                show(baking.progress().state, baking.progress().share);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    if (!baking.succeeded())
        fail(baking.errorKind(), "{}: bakes: 'sward bake {}' failed: {}", scene,
             fmt::join(bake.shown.begin(), bake.shown.end(), " "), baking.complaint());
}

} // namespace

BakeRanges readBakeRanges(const json& object, const std::string& place, std::uint32_t maxFields)
{
    SettingsReader reader(object, place);
    BakeRanges ranges;
    int count = 1;
    reader.read("fields", count, 1, static_cast<int>(maxFields));
    ranges.count = static_cast<std::uint32_t>(count);
    if (!reader.has("ground"))
        fail(ErrorKind::input, "{}: missing", reader.placeOf("ground"));
    ranges.ground = readSetting("ground", reader.child("ground"), reader.placeOf("ground"));
    if (ranges.ground.words.empty())
        fail(ErrorKind::input, "{}: expected inputs of 'sward bake'", reader.placeOf("ground"));
    bool hasSeed = false;
    if (reader.has("options")) {
        const json& options = reader.child("options");
        if (!options.is_object())
            fail(ErrorKind::input, "{}: expected an object of options of 'sward bake'",
                 reader.placeOf("options"));
        for (const auto& [name, value] : options.items()) {
            const std::string own = reader.placeOf("options") + "." + name;
            if (isAmong(ownOptions, name))
                fail(ErrorKind::input, "{}: the set decides on this option", own);
            if (name.starts_with('-') || name == "set")
                fail(ErrorKind::input, "{}: expected an option without dashes{}", own,
                     name == "set" ? "; \"set\" stands beside \"options\"" : "");
            if (value.is_boolean() && !value.get<bool>())
                continue;
            hasSeed = hasSeed || name == "seed";
            ranges.settings.push_back(readSetting(name, value, own));
        }
    }
    if (reader.has("set")) {
        const json& keys = reader.child("set");
        if (!keys.is_object())
            fail(ErrorKind::input, "{}: expected an object of keys of a meadow",
                 reader.placeOf("set"));
        for (const auto& [key, value] : keys.items()) {
            const std::string own = reader.placeOf("set") + "." + key;
            if (value.is_boolean())
                fail(ErrorKind::input, "{}: expected numbers or texts", own);
            ranges.settings.push_back(readSetting("set " + key, value, own));
        }
    }
    if (!hasSeed)
        ranges.settings.push_back({.name = "seed", .range = usualSeeds});
    reader.finish();
    return ranges;
}

std::vector<DrawnBake> drawBakes(const BakeRanges& ranges, std::uint64_t seed,
                                 const fs::path& folder)
{
    std::vector<DrawnBake> bakes;
    for (std::size_t i = 0; i < ranges.count; ++i)
        bakes.push_back(drawBake(ranges, seed, folder, i));
    return bakes;
}

void bakeMissing(const std::vector<DrawnBake>& bakes, const fs::path& folder, std::size_t first,
                 const std::string& scene, bool showBar)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        fail(ErrorKind::io, "{}: cannot make this folder", folder.string());
    for (std::size_t i = 0; i < bakes.size(); ++i) {
        const DrawnBake& bake = bakes[(first + i) % bakes.size()];
        if (!fs::exists(folder / bake.file))
            bakeOne(bake, folder / bake.file, scene, showBar);
    }
}

} // namespace sward::view
