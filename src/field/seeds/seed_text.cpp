#include "core/error.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "field/seeds/seeds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace sward::field {
namespace {

using nlohmann::json;

constexpr std::string_view facings[] = {"outward", "shared", "free"};
constexpr double longest = 1e6;         // [m]
constexpr double farthestOrigin = 1e12; // [m]

json rangeOf(float low, float range)
{
    return json::array({low, range});
}

std::uint64_t parseSeed(const std::string& text, const std::string& place)
{
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed, 16);
    if (text.empty() || error != std::errc() || stop != end)
        fail(ErrorKind::input, "{}: \"{}\" is not a number of up to 16 hexadecimal digits", place,
             text);
    return seed;
}

shared::SowSpecies parseSpeciesOf(const json& object, const std::string& place)
{
    shared::SowSpecies species = {};
    SettingsReader reader(object, place);
    glm::vec2 height(0.0f);
    glm::vec2 width(0.0f);
    glm::vec2 stiffness(0.0f);
    reader.read("share", species.share, 0.0, 1.0);
    reader.read("height", height, 0.0, longest);
    reader.read("width", width, 0.0, longest);
    reader.read("stiffness", stiffness, 0.0, 1.0);
    reader.read("clumping", species.clumping, 0.0, 1.0);
    species.facing = reader.readWord("facing", facings, shared::sowFree);
    int ribbons = 0;
    reader.read("ribbons", ribbons, 0, 63);
    reader.finish();
    species.heightLow = height.x;
    species.heightRange = height.y;
    species.widthLow = width.x;
    species.widthRange = width.y;
    species.stiffnessLow = stiffness.x;
    species.stiffnessRange = stiffness.y;
    species.ribbons = static_cast<std::uint32_t>(ribbons);
    return species;
}

} // namespace

std::string seedMeadowText(const SeedMeadow& meadow)
{
    json species = json::array();
    for (const shared::SowSpecies& one : meadow.species)
        species.push_back({{"share", one.share},
                           {"height", rangeOf(one.heightLow, one.heightRange)},
                           {"width", rangeOf(one.widthLow, one.widthRange)},
                           {"stiffness", rangeOf(one.stiffnessLow, one.stiffnessRange)},
                           {"clumping", one.clumping},
                           {"facing", facings[one.facing]},
                           {"ribbons", one.ribbons}});
    return jsonText(json{{"seed", fmt::format("{:x}", meadow.seed)},
                         {"density", meadow.density},
                         {"scale", meadow.scale},
                         {"clump_spacing", meadow.clumpSpacing},
                         {"stored", meadow.stored},
                         {"stored_widening", meadow.storedWidening},
                         {"unit_bits", meadow.unitBits},
                         {"levels", meadow.levels},
                         {"mixed", meadow.isMixed},
                         {"height_waves", meadow.heightWaves},
                         {"drifts", meadow.drifts},
                         {"sparse_height", meadow.sparseHeight},
                         {"wide_variation", meadow.wideVariation},
                         {"crease_reach", meadow.creaseReach},
                         {"crease_blend", meadow.creaseBlend},
                         {"vertical", meadow.vertical},
                         {"radial", meadow.isRadial},
                         {"up", json::array({meadow.up.x, meadow.up.y, meadow.up.z})},
                         {"highest", meadow.highest},
                         {"widest", meadow.widest},
                         {"species", species}});
}

SeedMeadow parseSeedMeadow(std::string_view text, const std::string& place)
{
    const json object = parseJson(text, place);
    SeedMeadow meadow;
    SettingsReader reader(object, place);
    std::string seed;
    reader.read("seed", seed);
    meadow.seed = parseSeed(seed, place);
    int unitBits = 20;
    int levels = 0;
    reader.read("density", meadow.density, 0.0, 1e15);
    reader.read("scale", meadow.scale, 1e-3, 1e5);
    reader.read("clump_spacing", meadow.clumpSpacing, 0.0, 1e9);
    reader.read("stored", meadow.stored, 0.0, 1.0);
    reader.read("stored_widening", meadow.storedWidening, 1.0, 2.0);
    reader.read("unit_bits", unitBits, 11, 24);
    reader.read("levels", levels, 0, 10);
    reader.read("mixed", meadow.isMixed);
    reader.read("height_waves", meadow.heightWaves, 0.0, 0.5);
    reader.read("drifts", meadow.drifts, 0.0, 1.0);
    reader.read("sparse_height", meadow.sparseHeight, 0.0, 1.0);
    reader.read("wide_variation", meadow.wideVariation, 0.0, 1.0);
    reader.read("crease_reach", meadow.creaseReach, 0.0, longest);
    reader.read("crease_blend", meadow.creaseBlend, 0.0, 1.0);
    reader.read("vertical", meadow.vertical, 0.0, 1.0);
    reader.read("radial", meadow.isRadial);
    reader.read("up", meadow.up, -farthestOrigin, farthestOrigin);
    reader.read("highest", meadow.highest, 1e-9, longest);
    reader.read("widest", meadow.widest, 1e-9, longest);
    meadow.unitBits = static_cast<std::uint32_t>(unitBits);
    meadow.levels = static_cast<std::uint32_t>(levels);
    const json& species = reader.child("species");
    reader.finish();
    if (!species.is_array() || species.empty() || species.size() > shared::maxSpecies)
        fail(ErrorKind::input, "{}: expected an array of 1 to {} species", place,
             shared::maxSpecies);
    for (const json& one : species)
        meadow.species.push_back(
            parseSpeciesOf(one, fmt::format("{}: species {}", place, meadow.species.size())));
    return meadow;
}

} // namespace sward::field
