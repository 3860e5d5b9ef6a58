#include "terrain/mesh_files/mtl_import.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/files/mapped_file.h"
#include "terrain/files/near_file.h"
#include "terrain/image/image_decode.h"
#include "terrain/mesh_files/text_cursor.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace sward::terrain {
namespace {

constexpr std::size_t libraryLimit = std::size_t(16) << 20; // [bytes]

// Options of map_Kd and their maximum number of arguments; numeric options may have fewer.
struct MapOption {
    std::string_view name;
    int words;
    bool areNumbers;
};
constexpr std::array<MapOption, 11> mapOptions = {{{"-blendu", 1, false},
                                                   {"-blendv", 1, false},
                                                   {"-cc", 1, false},
                                                   {"-clamp", 1, false},
                                                   {"-imfchan", 1, false},
                                                   {"-mm", 2, true},
                                                   {"-bm", 1, true},
                                                   {"-o", 3, true},
                                                   {"-s", 3, true},
                                                   {"-t", 3, true},
                                                   {"-texres", 1, true}}};

std::string_view trimmed(std::string_view text)
{
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

bool isFile(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

class MtlReader {
public:
    MtlReader(const std::filesystem::path& obj, std::uint32_t storedChannels, Soup& soup,
              Diagnostics& diagnostics)
        : place_(obj.string())
        , folder_(obj.parent_path())
        , soup_(soup)
        , diagnostics_(diagnostics)
        , isKnown_(soup.materials.size(), false)
    {
        budget_.storedChannels = storedChannels;
        for (std::size_t i = 0; i < soup.materials.size(); ++i)
            indices_.emplace(soup.materials[i].name, i);
    }

    void read(const std::string& library)
    {
        if (const std::filesystem::path whole = fileNamed(folder_, library, place_); isFile(whole))
            return readLibrary(whole);
        // No file has this name with spaces: treat it as several names.
        TextCursor words(library);
        for (std::string_view name = words.word(); !name.empty(); name = words.word()) {
            const std::filesystem::path file = fileNamed(folder_, name, place_);
            if (isFile(file))
                readLibrary(file);
            else
                diagnostics_.warn("{}: its material library {} is missing, and with it colours and "
                                  "images",
                                  place_, name);
            wasMissing_ = wasMissing_ || !isFile(file);
        }
    }

    void warnOfUnknown() const
    {
        if (wasMissing_)
            return;
        std::vector<std::string> unknown;
        for (std::size_t i = 0; i < soup_.materials.size(); ++i)
            if (!isKnown_[i] && soup_.materials[i].name != "ground")
                unknown.push_back(soup_.materials[i].name);
        const std::size_t count = unknown.size();
        unknown.resize(std::min<std::size_t>(count, 8));
        if (count > 0)
            diagnostics_.warn("{}: no library defines {} of its materials: {}{}", place_, count,
                              fmt::join(unknown, ", "), count > unknown.size() ? ", …" : "");
    }

private:
    // Resolves a name in an OBJ or MTL to a file in the same folder; both slashes are usual. Of an
    // absolute path of another machine it takes the last part.
    std::filesystem::path fileNamed(const std::filesystem::path& folder, std::string_view name,
                                    const std::string& place)
    {
        std::string text(name);
        std::replace(text.begin(), text.end(), '\\', '/');
        const std::filesystem::path relative(text);
        const std::filesystem::path file = fileOrNear(folder, text, place, diagnostics_);
        return isFile(file) ? file
                            : fileOrNear(folder, relative.filename().string(), place, diagnostics_);
    }

    void readLibrary(const std::filesystem::path& file)
    {
        if (!read_.insert(file.string()).second)
            return;
        const std::vector<std::byte> bytes = readFile(file, libraryLimit);
        TextCursor cursor(withoutMark({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
        GroundMaterial* material = nullptr;
        while (!cursor.atEnd()) {
            const std::string_view line = cursor.line();
            TextCursor words(line);
            const std::string_view keyword = words.word();
            const std::string_view rest =
                trimmed(line.substr(std::min(words.offset(), line.size())));
            if (keyword == "newmtl")
                material = materialNamed(rest);
            else if (material != nullptr && keyword == "Kd")
                readColor(words, file, cursor.lineNumber(), *material);
            else if (material != nullptr && keyword == "map_Kd")
                readMap(rest, file, *material);
        }
    }

    GroundMaterial* materialNamed(std::string_view name)
    {
        const auto found = indices_.find(std::string(name));
        if (found == indices_.end())
            return nullptr; // defined, but not used
        isKnown_[found->second] = true;
        return &soup_.materials[found->second];
    }

    void readColor(TextCursor& words, const std::filesystem::path& file, std::size_t line,
                   GroundMaterial& material)
    {
        glm::vec4 color(1.0f);
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const auto number = words.number();
            if (!number) {
                diagnostics_.warn("{}: line {}: Kd is not three numbers; it is ignored",
                                  file.string(), line);
                return;
            }
            color[channel] = static_cast<float>(std::clamp(*number, 0.0, 1.0));
        }
        material.baseColor = color;
    }

    void readMap(std::string_view rest, const std::filesystem::path& file, GroundMaterial& material)
    {
        // Parse options first, then a name that may contain spaces.
        while (!rest.empty() && rest.front() == '-') {
            TextCursor words(rest);
            const std::string_view name = words.word();
            const auto option = std::find_if(mapOptions.begin(), mapOptions.end(),
                                             [&](const MapOption& o) { return o.name == name; });
            if (option == mapOptions.end())
                break;
            std::size_t behind = words.offset();
            for (int i = 0; i < option->words; ++i) {
                const std::string_view word = words.word();
                if (option->areNumbers && !parseNumber(word))
                    break;
                if (name == "-clamp" && word == "on")
                    material.wrapU = material.wrapV = ImageWrap::clamp;
                behind = words.offset();
            }
            if (name == "-o" || name == "-s" || name == "-t")
                diagnostics_.warn("{}: material \"{}\": {} of its image is not applied",
                                  file.string(), material.name, name);
            rest = trimmed(rest.substr(std::min(behind, rest.size())));
        }
        if (!rest.empty())
            material.image = imageIn(fileNamed(file.parent_path(), rest, file.string()));
        // If there is no colour, use the image unchanged.
        if (material.image != GroundMaterial::noImage &&
            material.baseColor == GroundMaterial{}.baseColor)
            material.baseColor = glm::vec4(1.0f);
    }

    std::uint32_t imageIn(const std::filesystem::path& file)
    {
        const auto [known, isNew] = images_.try_emplace(file.string(), GroundMaterial::noImage);
        if (!isNew)
            return known->second;
        try {
            const MappedFile mapped(file);
            GroundImage image = decodeImage(mapped.bytes(), file.string(), budget_, diagnostics_);
            if (image.width == 0)
                return GroundMaterial::noImage;
            image.name = file.filename().string();
            soup_.images.push_back(std::move(image));
            known->second = static_cast<std::uint32_t>(soup_.images.size() - 1);
        } catch (const Error&) {
            diagnostics_.warn(
                "{}: the image {} cannot be read; its material is drawn without an image", place_,
                file.string());
        }
        return known->second;
    }

    std::string place_;
    std::filesystem::path folder_;
    Soup& soup_;
    Diagnostics& diagnostics_;
    std::vector<bool> isKnown_;                  // per material
    std::map<std::string, std::size_t> indices_; // of materials
    std::set<std::string> read_;                 // libraries
    bool wasMissing_ = false;
    ImageBudget budget_;
    std::map<std::string, std::uint32_t> images_;
};

} // namespace

void readMtl(const std::filesystem::path& path, const std::vector<std::string>& libraries,
             std::uint32_t storedChannels, Soup& soup, Diagnostics& diagnostics)
{
    MtlReader reader(path, storedChannels, soup, diagnostics);
    for (const std::string& library : libraries)
        reader.read(library);
    reader.warnOfUnknown();
}

} // namespace sward::terrain
