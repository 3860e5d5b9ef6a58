#include "apps/sward_view/fields/meadow_species.h"

#include "apps/sward_view/fields/meadow_requests.h"
#include "apps/sward_view/files/free_name.h"
#include "core/embedded.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace sward::embedded {
std::span<const EmbeddedFile> meadowTexts();
} // namespace sward::embedded

namespace sward::view {
namespace {

using nlohmann::json;

constexpr float minColorful = 0.1f; ///< of an organ that counts as a flower
constexpr std::size_t largestMeadow = std::size_t(16) << 20; ///< [bytes]

std::string sourceOf(const MeadowRequests& requests)
{
    return requests.meadowFile.empty()
               ? meadowPresets[static_cast<std::size_t>(requests.meadow)].name
               : requests.meadowFile;
}

std::string textOf(const MeadowRequests& requests)
{
    if (requests.meadowFile.empty())
        return textOfPreset(static_cast<std::size_t>(requests.meadow));
    const std::vector<std::byte> bytes = readFile(requests.meadowFile, largestMeadow);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void readNumbers(const json& from, const char* key, float* values, std::size_t count)
{
    const auto found = from.find(key);
    if (found == from.end())
        return;
    if (count == 3 && found->is_string())
        if (const auto color = colorOfHex(found->get_ref<const std::string&>()))
            for (std::size_t i = 0; i < 3; ++i)
                values[i] = (*color)[static_cast<glm::length_t>(i)];
    if (count == 2 && found->is_number())
        values[0] = values[1] = found->get<float>();
    if (!found->is_array() || found->size() != count)
        return;
    for (std::size_t i = 0; i < count; ++i)
        if ((*found)[i].is_number())
            values[i] = (*found)[i].get<float>();
}

// The tip of the organ that is least like a leaf.
std::optional<glm::vec3> flowerOf(const json& organs)
{
    std::optional<glm::vec3> flower;
    float most = minColorful;
    for (const json& organ : organs) {
        glm::vec3 tip(0.0f);
        if (organ.is_object())
            readNumbers(organ, "tip_color", &tip.x, 3);
        const float colorful = tip.x + tip.z - tip.y;
        if (colorful > most) {
            most = colorful;
            flower = tip;
        }
    }
    return flower;
}

// Replaces the numbers of a key that have changed.
void writeNumbers(json& to, const char* key, const float* values, const float* before,
                  std::size_t count)
{
    if (std::equal(values, values + count, before))
        return;
    json numbers = json::array();
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(values[i]);
    to[key] = std::move(numbers);
}

} // namespace

std::string presetNames()
{
    std::string names;
    for (const MeadowPreset& preset : meadowPresets)
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    return names;
}

std::string textOfPreset(std::size_t preset)
{
    const std::string name = std::string(meadowPresets[preset].name) + ".json";
    for (const EmbeddedFile& file : embedded::meadowTexts())
        if (file.name == name)
            return std::string(file.text());
    fail(ErrorKind::input, "{}: no such meadow", name);
}

std::vector<MeadowSpecies> speciesOf(const std::string& text, const std::string& source)
{
    const json meadow = parseJson(text, source);
    const auto found = meadow.is_object() ? meadow.find("species") : meadow.end();
    if (!meadow.is_object() || found == meadow.end() || !found->is_array() || found->empty())
        fail(ErrorKind::input, "{}: not a meadow; it has no list \"species\"", source);
    std::vector<MeadowSpecies> all;
    for (const json& one : *found) {
        if (!one.is_object())
            fail(ErrorKind::input, "{}: species {} is not an object", source, all.size());
        MeadowSpecies species;
        const auto name = one.find("name");
        if (name != one.end() && name->is_string())
            species.name = name->get<std::string>();
        const auto share = one.find("share");
        if (share != one.end() && share->is_number())
            species.share = share->get<float>();
        readNumbers(one, "height_m", &species.height.x, 2);
        readNumbers(one, "root_color", &species.root.x, 3);
        readNumbers(one, "tip_color", &species.tip.x, 3);
        const auto organs = one.find("organs");
        if (organs != one.end() && organs->is_array())
            species.flower = flowerOf(*organs);
        all.push_back(std::move(species));
    }
    return all;
}

MeadowEditor::MeadowEditor(const MeadowRequests& requests)
    : source_(sourceOf(requests))
    , text_(textOf(requests))
    , read_(speciesOf(text_, source_))
{
    species = read_;
}

bool MeadowEditor::isOf(const MeadowRequests& requests) const
{
    return sourceOf(requests) == source_;
}

std::string MeadowEditor::text() const
{
    auto meadow = nlohmann::ordered_json::parse(text_);
    auto& list = meadow["species"];
    for (std::size_t i = 0; i < species.size(); ++i) {
        const MeadowSpecies& now = species[i];
        const MeadowSpecies& before = read_[i];
        json changed = json::object();
        if (now.share != before.share)
            changed["share"] = now.share;
        writeNumbers(changed, "height_m", &now.height.x, &before.height.x, 2);
        writeNumbers(changed, "root_color", &now.root.x, &before.root.x, 3);
        writeNumbers(changed, "tip_color", &now.tip.x, &before.tip.x, 3);
        for (const auto& [key, value] : changed.items())
            list[i][key] = value;
    }
    return jsonText(meadow, 2) + "\n";
}

std::string MeadowEditor::file() const
{
    return isOwn_ ? source_ : freeName(fieldNameFor(source_)).replace_extension(".json").string();
}

void MeadowEditor::save(const std::string& path, bool replaces, MeadowRequests& requests)
{
    const std::string written = text();
    writeTextFile(path, written, replaces);
    text_ = written;
    read_ = species;
    source_ = path;
    isOwn_ = true;
    requests.meadowFile = path;
}

} // namespace sward::view
