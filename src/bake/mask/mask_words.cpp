#include "bake/mask/mask_words.h"

#include "core/json/settings_json.h"
#include "core/lower_case.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

namespace sward::bake {
namespace {

constexpr std::array<std::string_view, 5> imageEndings{".png", ".jpg", ".jpeg", ".tga", ".bmp"};

std::vector<std::string> wordsOf(const std::string& text)
{
    std::vector<std::string> words(1);
    for (const char c : text)
        if (c == ':')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

bool isImageName(const std::string& word)
{
    const std::string lower = lowerCase(word);
    return std::any_of(imageEndings.begin(), imageEndings.end(),
                       [&](std::string_view ending) { return lower.ends_with(ending); });
}

bool isChannel(const std::string& word)
{
    return word == "R" || word == "G" || word == "B" || word == "A";
}

bool isSet(const std::string& word)
{
    return word.size() > 2 && word.starts_with("uv") &&
           std::all_of(word.begin() + 2, word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Names a word that is none of `known`.
std::string unknown(const std::string& word, const std::vector<std::string>& known)
{
    std::string upper;
    for (const char c : word)
        upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const bool isSmall =
        isChannel(upper) && std::find(known.begin(), known.end(), "R") != known.end();
    const std::string near = isSmall           ? upper
                             : word.size() < 2 ? std::string()
                                               : nearestWord(word, known);
    return fmt::format("\"{}\" is not one of {}{}", word, fmt::join(known, ", "),
                       near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

// Words behind a mask's source. `optional`: what may follow the channel, in this order.
std::string troubleBehind(const std::vector<std::string>& words, std::size_t first,
                          bool needsChannel, const std::vector<std::string>& optional)
{
    std::vector<std::string> known{"R", "G", "B", "A"};
    known.insert(known.end(), optional.begin(), optional.end());
    const auto rank = [&](const std::string& word) {
        if (isChannel(word))
            return std::size_t(0);
        const std::string name = isSet(word) ? "uv1" : word;
        const auto found = std::find(optional.begin(), optional.end(), name);
        return found == optional.end() ? known.size()
                                       : 1 + static_cast<std::size_t>(found - optional.begin());
    };
    std::size_t before = 0;
    bool isFirst = true;
    for (std::size_t i = first; i < words.size(); ++i) {
        const std::size_t own = rank(words[i]);
        if (own == known.size())
            return unknown(words[i], known);
        if (!isFirst && own <= before)
            return fmt::format("\"{}\" stands behind \"{}\"; the order is C{}{}", words[i],
                               words[i - 1], optional.empty() ? "" : ", ",
                               fmt::join(optional, ", "));
        before = own;
        isFirst = false;
    }
    if (needsChannel && (words.size() <= first || !isChannel(words[first])))
        return "a channel R, G, B or A is missing";
    return {};
}

// A word behind a map's name, wherever it stands.
std::string troubleOfRasterWord(const std::string& word)
{
    if (word == "invert" || !classesOf(word).empty() || rangeOf(word))
        return {};
    const auto isAmong = [](std::string_view letters) {
        return [letters](char c) { return letters.find(c) != std::string_view::npos; };
    };
    if (word.size() > 1 && word[0] == 'b' &&
        std::all_of(word.begin() + 1, word.end(), isAmong("0123456789.-+"))) {
        int band = 0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data() + 1, end, band);
        return error == std::errc() && stop == end && band >= 1
                   ? std::string()
                   : fmt::format("\"{}\" is no band; the first one is b1", word);
    }
    if (word.find("..") != std::string::npos)
        return fmt::format("\"{}\" is no range; A..B has two finite numbers that differ", word);
    if (word.find(',') != std::string::npos ||
        (!word.empty() && std::all_of(word.begin(), word.end(), isAmong("0123456789.-+e"))))
        return fmt::format("\"{}\" is no list of values; V,V has finite numbers with commas "
                           "between them",
                           word);
    return unknown(word, {"bN", "V,V", "A..B", "invert"});
}

} // namespace

std::vector<double> classesOf(std::string_view text)
{
    std::vector<double> classes;
    for (const char *at = text.data(), *const end = at + text.size();; ++at) {
        double value = 0.0;
        const auto [stop, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !std::isfinite(value))
            return {};
        classes.push_back(value);
        if (stop == end)
            return classes;
        if (*stop != ',')
            return {};
        at = stop;
    }
}

std::optional<glm::dvec2> rangeOf(std::string_view text)
{
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos)
        return std::nullopt;
    const std::vector<double> low = classesOf(text.substr(0, dots));
    const std::vector<double> high = classesOf(text.substr(dots + 2));
    if (low.size() != 1 || high.size() != 1 || low[0] == high[0] ||
        !std::isfinite(high[0] - low[0]))
        return std::nullopt;
    return glm::dvec2(low[0], high[0]);
}

std::string rasterTrouble(const std::string& file)
{
    const std::vector<std::string> words = wordsOf(file);
    std::string name;
    std::size_t first = 0; // behind the file's name
    for (std::size_t i = 0; i < words.size() && first == 0; ++i) {
        name += (i == 0 ? "" : ":") + words[i];
        const std::string lower = lowerCase(words[i]);
        std::error_code ignored;
        if (lower.ends_with(".tif") || lower.ends_with(".tiff") ||
            std::filesystem::is_regular_file(name, ignored))
            first = i + 1;
    }
    if (first == 0 || first == words.size())
        return {};
    for (std::size_t i = first; i < words.size(); ++i)
        if (const std::string trouble = troubleOfRasterWord(words[i]); !trouble.empty())
            return trouble;
    return fmt::format("\"{}\" stands too early or twice; behind the file come bN, V,V or A..B, "
                       "and invert, in this order",
                       words[first]);
}

std::string maskTrouble(const std::string& text)
{
    const std::vector<std::string> words = wordsOf(text);
    const std::string& kind = words.front();
    if (kind == "ground") {
        if (words.size() < 2 || words[1] != "green")
            return unknown(words.size() < 2 ? "" : words[1], {"green"});
        return words.size() > 2 && words[2] != "invert" ? unknown(words[2], {"invert"}) : "";
    }
    if (kind == "texture") {
        // A file's name may have colons: its words begin behind the one that ends as an image.
        const auto file = std::find_if(words.begin() + 1, words.end(), isImageName);
        if (file == words.end())
            return {};
        return troubleBehind(words, static_cast<std::size_t>(file - words.begin()) + 1, false,
                             {"uv1", "transform", "invert"});
    }
    if (kind == "raster")
        return words.size() < 2 || words[1].empty() ? "a file is missing" : "";
    if (kind == "material-texture")
        return troubleBehind(words, 1, true, {"invert"});
    if (kind.starts_with("vertex-color")) {
        if (words.size() > 1 && words[1].starts_with("_"))
            return troubleBehind(words, 2, false, {"or-white", "invert"});
        return troubleBehind(words, 1, true, {"or-white", "invert"});
    }
    if (isImageName(kind)) {
        std::string rest = text.substr(kind.size());
        const std::string trouble = troubleBehind(words, 1, false, {"uv1", "transform", "invert"});
        return fmt::format("an image is named as texture:{}{}{}", kind,
                           words.size() > 1 && isChannel(words[1]) ? "" : ":R",
                           trouble.empty() ? rest : fmt::format(" …, and {}", trouble));
    }
    return unknown(kind, {"ground", "vertex-color", "material-texture", "texture", "raster"});
}

} // namespace sward::bake
