#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward {

/// Reads a JSON object strictly: every key must be read, every value must be in its range. An
/// unknown key is an error that proposes the nearest known one. Include from .cpp files only.
class SettingsReader {
public:
    /// `place` names the object in messages: the file, then the path inside it.
    SettingsReader(const nlohmann::json& object, std::string place);

    /// Whether `key` exists. Marks it as known.
    bool has(std::string_view key);

    /// Each leaves `value` unchanged if the key is absent. Throws Error{input} on a wrong type, a
    /// value that is not finite, or one outside [low, high].
    void read(const char* key, double& value, double low, double high);
    void read(const char* key, float& value, double low, double high);
    void read(const char* key, int& value, int low, int high);
    void read(const char* key, bool& value);
    void read(const char* key, std::string& value);
    void read(const char* key, glm::vec2& value, double low, double high);
    void read(const char* key, glm::dvec2& value, double low, double high);
    void read(const char* key, glm::vec3& value, double low, double high);
    void read(const char* key, glm::dvec3& value, double low, double high);

    /// The same of a range: an array of its two ends, the lower one first, or one number that is
    /// both. Throws Error{input} with both if the first is above the second.
    void readRange(const char* key, glm::dvec2& range, double low, double high);

    /// The same of the values at two ends, in any order, or one number that is both.
    void readEnds(const char* key, glm::vec2& ends, double low, double high);

    /// The same of a colour of linear light: three numbers, or an sRGB colour as "#rrggbb".
    void readColor(const char* key, glm::vec3& color, double low, double high);

    /// Reads `key`, or its former name if the file uses that, which adds a warning. Throws
    /// Error{input} if the file has both.
    void readRenamed(const char* key, const char* former, float& value, double low, double high);

    /// One text for each former name that was read.
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// Index into `words` of the text under `key`; `value` if the key is absent. Throws
    /// Error{input} with the list of words and the nearest one if the text is not among them.
    std::uint32_t readWord(const char* key, std::span<const std::string_view> words,
                           std::uint32_t value);

    /// The child under `key`; it must exist.
    const nlohmann::json& child(const char* key);
    std::string placeOf(std::string_view key) const;

    /// Throws Error{input} if the object has a key that was not read.
    void finish() const;

private:
    const nlohmann::json* find(const char* key);
    template <typename Vec>
    void readBoth(const char* key, Vec& ends, double low, double high);

    const nlohmann::json& object_;
    std::string place_;
    std::vector<std::string> known_;
    std::vector<std::string> former_; ///< known, but not proposed for an unknown key
    std::vector<std::string> warnings_;
};

/// Parses text as JSON. Throws Error{input} that names `place`, line and column if the text is
/// malformed, has a key twice in one object or is beyond the limits (json_check.h).
nlohmann::json parseJson(std::string_view text, const std::string& place);

/// Linear light of an sRGB colour "#rrggbb", rounded to six decimals; none for any other text.
std::optional<glm::vec3> colorOfHex(std::string_view text);

/// The entry of `known` nearest to `word` by edit distance, or an empty text if none is near.
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);

} // namespace sward
