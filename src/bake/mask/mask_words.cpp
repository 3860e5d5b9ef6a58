#include "bake/mask/mask_words.h"

#include "core/json/settings_json.h"
#include "core/lower_case.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
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

} // namespace

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
