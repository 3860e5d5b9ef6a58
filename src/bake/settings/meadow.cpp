#include "bake/settings/meadow.h"

#include "bake/mask/mask_words.h"
#include "bake/settings/meadow_json.h"
#include "core/embedded.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

namespace sward::embedded {
std::span<const EmbeddedFile> meadows();
} // namespace sward::embedded

namespace sward::bake {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 3> facingNames{"outward", "shared", "free"};

// Reads a soft range from a text such as "0:30~5", or from its two ends.
void readSoft(SettingsReader& reader, const char* key, SoftRange& range)
{
    if (!reader.has(key))
        return;
    const json& value = reader.child(key);
    if (value.is_array()) {
        glm::dvec2 ends(0.0);
        reader.readRange(key, ends, -unbounded, unbounded);
        range.low = ends.x;
        range.high = ends.y;
        return;
    }
    std::string text;
    if (value.is_number())
        fail(ErrorKind::input,
             "{}: one number does not tell which end it is; expected \"MIN:\", \":MAX\", "
             "\"MIN:MAX\" or \"MIN:MAX~SOFT\"",
             reader.placeOf(key));
    reader.read(key, text);
    if (text.empty())
        return;
    const std::optional<SoftRange> read = readSoftRange(text, range);
    if (!read)
        fail(ErrorKind::input, "{}: \"{}\" is not MIN:MAX or MIN:MAX~SOFT", reader.placeOf(key),
             text);
    range = *read;
}

// Reads one mask or a list of them.
void readMasks(SettingsReader& reader, const char* key, std::vector<Mask>& masks)
{
    if (!reader.has(key))
        return;
    const json& value = reader.child(key);
    for (const json& entry : value.is_array() ? value : json::array({value})) {
        const std::optional<Mask> mask =
            entry.is_string() ? readMask(entry.get<std::string>()) : std::nullopt;
        if (!mask) {
            const std::string trouble =
                entry.is_string() ? maskTrouble(entry.get<std::string>()) : std::string();
            fail(ErrorKind::input, "{}: {} is not a mask such as \"vertex-color:R:invert\"{}{}",
                 reader.placeOf(key), jsonText(entry), trouble.empty() ? "" : ": ", trouble);
        }
        masks.push_back(*mask);
    }
}

// Shortest decimal that reads back as the same float: 0.45, not 0.44999998807907104.
double shortest(float value)
{
    return std::stod(fmt::format("{}", value));
}

SpeciesTraits parseSpecies(const json& object, const std::string& place)
{
    SpeciesTraits species;
    shared::Species& look = species.look;
    look.rootColor = glm::vec3(0.035f, 0.06f, 0.012f);
    look.tipColor = glm::vec3(0.24f, 0.36f, 0.06f);
    look.tipThreshold = 0.35f;
    look.groundTint = 0.35f;
    look.colorVariation = 0.4f;
    look.translucency = 0.5f;
    look.gloss = 0.3f;
    look.dryness = 0.1f;

    SettingsReader reader(object, place);
    reader.read("name", species.name);
    reader.read("share", species.share, 1e-6, 1e6);
    reader.read("priority", species.priority, -1000, 1000);
    reader.read("cover", species.cover, 1e-6, 1.0);
    readSoft(reader, "slope", species.habitat.slope);
    readSoft(reader, "altitude", species.habitat.altitude);
    readSoft(reader, "curvature", species.habitat.curvature);
    readMasks(reader, "mask", species.habitat.masks);
    reader.readRange("height_m", species.height, 1e-6, 1e4);
    reader.readRange("width_m", species.width, 1e-7, 1e3);
    reader.readRange("stiffness", species.stiffness, 0.0, 1.0);
    reader.read("clumping", species.clumping, 0.0, 1.0);
    species.facing = static_cast<Facing>(
        reader.readWord("facing", facingNames, static_cast<std::uint32_t>(species.facing)));
    reader.read("tuft_spacing_m", species.tuftSpacing, 0.0, 1e6);
    reader.read("tuft_radius_m", species.tuftRadius, 0.0, 1e6);
    reader.read("tuft_lean", species.tuftLean, 0.0, 1.0);
    reader.read("tuft_litter", species.tuftLitter, 0.0, 1.0);
    reader.readColor("root_color", look.rootColor, 0.0, 1.0);
    reader.readColor("tip_color", look.tipColor, 0.0, 1.0);
    reader.read("tip_threshold", look.tipThreshold, 0.0, 0.99);
    reader.read("ground_tint", look.groundTint, 0.0, 1.0);
    reader.read("color_variation", look.colorVariation, 0.0, 1.0);
    reader.read("translucency", look.translucency, 0.0, 1.0);
    reader.read("gloss", look.gloss, 0.0, 1.0);
    reader.read("dryness", look.dryness, 0.0, 1.0);
    look.shape = reader.readWord("shape", field::shapeNames, look.shape);
    reader.read("fold", look.fold, 0.0, 1.0);
    if (reader.has("organs"))
        species.organs = field::parseOrgans(reader.child("organs"), reader.placeOf("organs"));
    reader.finish();
    return species;
}

std::string stem(std::string_view fileName)
{
    return std::filesystem::path(fileName).stem().string();
}

template <typename Vec>
json toArray(const Vec& v)
{
    if constexpr (Vec::length() == 2)
        return json::array({v.x, v.y});
    else
        return json::array({shortest(v.x), shortest(v.y), shortest(v.z)});
}

} // namespace

Meadow parseMeadow(std::string_view text, const std::string& place)
{
    const json object = parseJson(text, place);
    Meadow meadow = meadowFromJson(object, place);
    requireOwnNames(object, place);
    return meadow;
}

void requireOwnNames(const json& meadow, const std::string& place)
{
    const json& list = meadow.at("species");
    for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t j = 0; j < i && list[i].contains("name"); ++j)
            if (list[j].contains("name") && list[i]["name"] == list[j]["name"])
                fail(ErrorKind::input,
                     "{}: species[{}] and species[{}] are both named {}; strokes and reports tell "
                     "species by their names",
                     place, j, i, jsonText(list[i]["name"]));
}

Meadow meadowFromJson(const json& object, const std::string& place)
{
    Meadow meadow;
    SettingsReader reader(object, place);
    reader.read("name", meadow.name);
    reader.read("clump_size_m", meadow.clumpSize, 0.0, 1e6);
    reader.read("sparse_height", meadow.sparseHeight, 0.0, 1.0);
    reader.read("height_waves", meadow.heightWaves, 0.0, 0.5);
    reader.read("wide_variation", meadow.wideVariation, 0.0, 1.0);
    reader.read("drifts", meadow.drifts, 0.0, 1.0);
    reader.read("cover_from_above", meadow.closedCover, 0.01, 0.999);
    reader.read("fit_overhangs", meadow.fitsOverhangs);
    EdgeTraits& edges = meadow.edges;
    reader.read("occluder_reach_m", edges.occluderReach, 0.0, 100.0);
    reader.read("occluder_height", edges.occluderHeight, 0.1, 4.0);
    reader.read("occluder_dryness", edges.occluderDryness, 0.0, 1.0);
    reader.read("path_reach_m", edges.pathReach, 0.0, 100.0);
    reader.read("path_height", edges.pathHeight, 0.05, 1.0);
    reader.read("path_lean", edges.pathLean, 0.0, 1.0);
    reader.read("crease_blend", edges.creaseBlend, 0.0, 1.0);
    const json& list = reader.child("species");
    reader.finish();
    if (!list.is_array() || list.empty() || list.size() > shared::maxSpecies)
        fail(ErrorKind::input, "{}: expected an array of 1 to {} species",
             reader.placeOf("species"), shared::maxSpecies);
    for (const json& entry : list)
        meadow.species.push_back(parseSpecies(
            entry, fmt::format("{}[{}]", reader.placeOf("species"), meadow.species.size())));
    return meadow;
}

Meadow loadMeadow(const std::string& fileOrName)
{
    // An existing file has precedence over a built-in meadow of the same name.
    std::error_code ignored;
    if (std::filesystem::is_regular_file(fileOrName, ignored)) {
        const std::vector<std::byte> bytes = readFile(fileOrName, std::size_t(1) << 24);
        Meadow meadow =
            parseMeadow({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, fileOrName);
        const std::filesystem::path folder = std::filesystem::path(fileOrName).parent_path();
        for (SpeciesTraits& species : meadow.species)
            for (Mask& mask : species.habitat.masks)
                if (!mask.file.empty())
                    mask.file = (folder / mask.file).string();
        return meadow;
    }
    for (const EmbeddedFile& file : embedded::meadows())
        if (stem(file.name) == fileOrName)
            return parseMeadow(file.text(), fmt::format("built-in meadow {}", fileOrName));
    if (std::filesystem::exists(fileOrName, ignored))
        fail(ErrorKind::io, "{}: not a regular file, and no built-in meadow", fileOrName);
    fail(ErrorKind::io, "{}: no such file, and no built-in meadow; those are {}", fileOrName,
         fmt::join(builtInMeadows(), ", "));
}

std::string toJson(const Meadow& meadow)
{
    return jsonText(meadowToJson(meadow), 2);
}

json meadowToJson(const Meadow& meadow)
{
    json list = json::array();
    for (const SpeciesTraits& one : meadow.species) {
        json masks = json::array();
        for (const Mask& mask : one.habitat.masks)
            masks.push_back(textOf(mask));
        list.push_back({{"name", one.name},
                        {"share", one.share},
                        {"priority", one.priority},
                        {"cover", one.cover},
                        {"slope", textOf(one.habitat.slope)},
                        {"altitude", textOf(one.habitat.altitude)},
                        {"curvature", textOf(one.habitat.curvature)},
                        {"mask", masks},
                        {"height_m", toArray(one.height)},
                        {"width_m", toArray(one.width)},
                        {"stiffness", toArray(one.stiffness)},
                        {"clumping", one.clumping},
                        {"facing", facingNames[static_cast<std::size_t>(one.facing)]},
                        {"tuft_spacing_m", one.tuftSpacing},
                        {"tuft_radius_m", one.tuftRadius},
                        {"tuft_lean", one.tuftLean},
                        {"tuft_litter", one.tuftLitter},
                        {"root_color", toArray(one.look.rootColor)},
                        {"tip_color", toArray(one.look.tipColor)},
                        {"tip_threshold", shortest(one.look.tipThreshold)},
                        {"ground_tint", shortest(one.look.groundTint)},
                        {"color_variation", shortest(one.look.colorVariation)},
                        {"translucency", shortest(one.look.translucency)},
                        {"gloss", shortest(one.look.gloss)},
                        {"dryness", shortest(one.look.dryness)},
                        {"shape", field::shapeNames[one.look.shape]},
                        {"fold", shortest(one.look.fold)}});
        if (!one.organs.empty())
            list.back()["organs"] = field::organsJson(one.organs);
    }
    return {{"name", meadow.name},
            {"clump_size_m", meadow.clumpSize},
            {"sparse_height", meadow.sparseHeight},
            {"height_waves", meadow.heightWaves},
            {"wide_variation", meadow.wideVariation},
            {"drifts", meadow.drifts},
            {"cover_from_above", meadow.closedCover},
            {"fit_overhangs", meadow.fitsOverhangs},
            {"occluder_reach_m", meadow.edges.occluderReach},
            {"occluder_height", meadow.edges.occluderHeight},
            {"occluder_dryness", meadow.edges.occluderDryness},
            {"path_reach_m", meadow.edges.pathReach},
            {"path_height", meadow.edges.pathHeight},
            {"path_lean", meadow.edges.pathLean},
            {"crease_blend", meadow.edges.creaseBlend},
            {"species", list}};
}

std::vector<std::string> builtInMeadows()
{
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embedded::meadows())
        names.push_back(stem(file.name));
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace sward::bake
