#include "core/json/settings_json.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/json/json_check.h"
#include "core/json/json_text.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace sward {
namespace {

// A value in a message: its beginning if it is long.
std::string shown(const nlohmann::json& value)
{
    constexpr std::size_t most = 80;
    if (value.is_structured() && value.size() > most)
        return fmt::format("{} of {} values", value.is_array() ? "an array" : "an object",
                           value.size());
    const std::string text = jsonText(value);
    return text.size() <= most ? text : toUtf8(text.substr(0, most)) + "…";
}

double readNumber(const nlohmann::json& value, const std::string& place, double low, double high)
{
    if (!value.is_number())
        fail(ErrorKind::input, "{}: expected a number, found {}", place, shown(value));
    const double number = value.get<double>();
    // Written so that NaN fails, too.
    if (!(number >= low && number <= high))
        fail(ErrorKind::input, "{}: {} is outside [{}, {}]", place, number, low, high);
    return number;
}

template <typename Vec>
void readVector(const nlohmann::json& value, const std::string& place, double low, double high,
                Vec& result)
{
    constexpr glm::length_t size = Vec::length();
    if (!value.is_array() || value.size() != size)
        fail(ErrorKind::input, "{}: expected an array of {} numbers, found {}", place, size,
             shown(value));
    for (glm::length_t i = 0; i < size; ++i)
        result[i] = static_cast<typename Vec::value_type>(
            readNumber(value[std::size_t(i)], place, low, high));
}

} // namespace

SettingsReader::SettingsReader(const nlohmann::json& object, std::string place)
    : object_(object)
    , place_(std::move(place))
{
    if (!object_.is_object())
        fail(ErrorKind::input, "{}: expected an object {{…}}, found {}", place_, shown(object_));
}

bool SettingsReader::has(std::string_view key)
{
    known_.emplace_back(key);
    return object_.contains(key);
}

std::string SettingsReader::placeOf(std::string_view key) const
{
    return fmt::format("{}: {}", place_, key);
}

const nlohmann::json* SettingsReader::find(const char* key)
{
    known_.emplace_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

void SettingsReader::read(const char* key, double& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        value = readNumber(*found, placeOf(key), low, high);
}

void SettingsReader::read(const char* key, float& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        value = static_cast<float>(readNumber(*found, placeOf(key), low, high));
}

void SettingsReader::read(const char* key, int& value, int low, int high)
{
    if (const nlohmann::json* found = find(key)) {
        const double number = readNumber(*found, placeOf(key), low, high);
        if (number != std::floor(number))
            fail(ErrorKind::input, "{}: {} is not a whole number", placeOf(key), number);
        value = static_cast<int>(number);
    }
}

void SettingsReader::read(const char* key, bool& value)
{
    if (const nlohmann::json* found = find(key)) {
        if (!found->is_boolean())
            fail(ErrorKind::input, "{}: expected true or false, found {}", placeOf(key),
                 shown(*found));
        value = found->get<bool>();
    }
}

void SettingsReader::read(const char* key, std::string& value)
{
    if (const nlohmann::json* found = find(key)) {
        if (!found->is_string())
            fail(ErrorKind::input, "{}: expected a text, found {}", placeOf(key), shown(*found));
        value = found->get<std::string>();
    }
}

void SettingsReader::read(const char* key, glm::vec2& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        readVector(*found, placeOf(key), low, high, value);
}

void SettingsReader::read(const char* key, glm::dvec2& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        readVector(*found, placeOf(key), low, high, value);
}

void SettingsReader::read(const char* key, glm::vec3& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        readVector(*found, placeOf(key), low, high, value);
}

void SettingsReader::read(const char* key, glm::dvec3& value, double low, double high)
{
    if (const nlohmann::json* found = find(key))
        readVector(*found, placeOf(key), low, high, value);
}

template <typename Vec>
void SettingsReader::readBoth(const char* key, Vec& ends, double low, double high)
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return;
    if (found->is_number())
        ends =
            Vec(static_cast<typename Vec::value_type>(readNumber(*found, placeOf(key), low, high)));
    else if (found->is_array() && found->size() == 2)
        readVector(*found, placeOf(key), low, high, ends);
    else
        fail(ErrorKind::input, "{}: expected a number or an array of 2 numbers, found {}",
             placeOf(key), shown(*found));
}

void SettingsReader::readRange(const char* key, glm::dvec2& range, double low, double high)
{
    readBoth(key, range, low, high);
    if (range.x > range.y)
        fail(ErrorKind::input, "{}: {} is above {}", placeOf(key), range.x, range.y);
}

void SettingsReader::readEnds(const char* key, glm::vec2& ends, double low, double high)
{
    readBoth(key, ends, low, high);
}

void SettingsReader::readColor(const char* key, glm::vec3& color, double low, double high)
{
    const nlohmann::json* const found = find(key);
    if (found == nullptr)
        return;
    if (found->is_string()) {
        const std::optional<glm::vec3> read = colorOfHex(found->get_ref<const std::string&>());
        if (!read)
            fail(ErrorKind::input,
                 "{}: expected 3 numbers of linear light or \"#rrggbb\", found {}", placeOf(key),
                 shown(*found));
        color = *read;
        return;
    }
    if (!found->is_array() || found->size() != 3)
        fail(ErrorKind::input, "{}: expected 3 numbers of linear light or \"#rrggbb\", found {}",
             placeOf(key), shown(*found));
    readVector(*found, placeOf(key), low, high, color);
}

void SettingsReader::readRenamed(const char* key, const char* former, float& value, double low,
                                 double high)
{
    former_.emplace_back(former);
    const auto found = object_.find(former);
    if (found == object_.end()) {
        read(key, value, low, high);
        return;
    }
    if (has(key))
        fail(ErrorKind::input, "{}: it has both \"{}\" and its former name \"{}\"", place_, key,
             former);
    value = static_cast<float>(readNumber(*found, placeOf(former), low, high));
    warnings_.push_back(fmt::format("{}: \"{}\" is now called \"{}\"", place_, former, key));
}

std::uint32_t SettingsReader::readWord(const char* key, std::span<const std::string_view> words,
                                       std::uint32_t value)
{
    std::string word(words[value]);
    read(key, word);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end())
        return static_cast<std::uint32_t>(found - words.begin());
    const std::string near = nearestWord(word, {words.begin(), words.end()});
    fail(ErrorKind::input, "{}: \"{}\" is not one of {}{}", placeOf(key), word,
         fmt::join(words, ", "), near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

const nlohmann::json& SettingsReader::child(const char* key)
{
    const nlohmann::json* found = find(key);
    if (found == nullptr)
        fail(ErrorKind::input, "{}: missing", placeOf(key));
    return *found;
}

void SettingsReader::finish() const
{
    for (const auto& [key, value] : object_.items()) {
        if (std::find(known_.begin(), known_.end(), key) != known_.end() ||
            std::find(former_.begin(), former_.end(), key) != former_.end())
            continue;
        const std::string near = nearestWord(key, known_);
        fail(ErrorKind::input, "{}: unknown key \"{}\"{}", place_, key,
             near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
    }
}

nlohmann::json parseJson(std::string_view text, const std::string& place)
{
    text = withoutMark(text);
    refuseForeign(std::as_bytes(std::span(text)), place);
    requireJson(text, place);
    nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    if (value.is_discarded())
        fail(ErrorKind::input, "{}: not valid JSON", place);
    return value;
}

std::optional<glm::vec3> colorOfHex(std::string_view text)
{
    if (text.size() != 7 || text[0] != '#')
        return std::nullopt;
    glm::vec3 color(0.0f);
    for (std::size_t i = 0; i < 3; ++i) {
        unsigned byte = 0;
        const char* const digits = text.data() + 1 + 2 * i;
        if (std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2)
            return std::nullopt;
        // In double precision and rounded, so that no library's pow() shows in a field's bytes.
        const double encoded = byte / 255.0;
        const double linear =
            encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        color[static_cast<glm::length_t>(i)] = static_cast<float>(std::round(linear * 1e6) / 1e6);
    }
    return color;
}

std::string nearestWord(std::string_view word, const std::vector<std::string>& known)
{
    std::string best;
    std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        // Levenshtein distance, one row at a time.
        std::vector<std::size_t> row(candidate.size() + 1);
        std::iota(row.begin(), row.end(), std::size_t(0));
        for (std::size_t i = 0; i < word.size(); ++i) {
            std::size_t diagonal = row[0];
            row[0] = i + 1;
            for (std::size_t j = 0; j < candidate.size(); ++j) {
                const std::size_t substituted = diagonal + (word[i] == candidate[j] ? 0 : 1);
                diagonal = row[j + 1];
                row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substituted});
            }
        }
        if (row.back() < bestDistance) {
            bestDistance = row.back();
            best = candidate;
        }
    }
    return best;
}

} // namespace sward
