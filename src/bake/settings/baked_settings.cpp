#include "bake/settings/baked_settings.h"

#include "bake/settings/meadow_json.h"
#include "core/error.h"
#include "core/json/settings_json.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

using nlohmann::json;

// Beyond any setting's own bounds, which validate() tests.
constexpr double anyNumber = 1e300;

std::optional<double> numberOf(SettingsReader& reader, const char* key)
{
    if (!reader.has(key) || reader.child(key).is_null())
        return std::nullopt;
    double value = 0.0;
    reader.read(key, value, -anyNumber, anyNumber);
    return value;
}

std::optional<std::uint64_t> wholeOf(SettingsReader& reader, const char* key)
{
    if (!reader.has(key) || reader.child(key).is_null())
        return std::nullopt;
    if (!reader.child(key).is_number_unsigned())
        fail(ErrorKind::input, "{}: is no whole number", reader.placeOf(key));
    return reader.child(key).get<std::uint64_t>();
}

void readRange(SettingsReader& reader, const char* key, SoftRange& range)
{
    glm::dvec3 ends(range.low, range.high, range.soft);
    reader.read(key, ends, -anyNumber, anyNumber);
    if (ends.x > ends.y || ends.z < 0.0)
        fail(ErrorKind::input, "{}: is no range of a lower end, an upper end and a fade",
             reader.placeOf(key));
    range = {ends.x, ends.y, ends.z};
}

constexpr std::array<std::string_view, 3> spreads{"uniform", "poisson", "poisson-dense"};
constexpr std::array<std::string_view, 3> sideNames{"front", "back", "both"};

// `words` in the order of the enumeration.
template <typename Value>
void readChoice(SettingsReader& reader, const char* key, std::span<const std::string_view> words,
                Value& value)
{
    value = static_cast<Value>(reader.readWord(key, words, static_cast<std::uint32_t>(value)));
}

void readGroundUp(SettingsReader& reader, GroundUp& up)
{
    if (!reader.has("ground_up"))
        return;
    const json& child = reader.child("ground_up");
    up.radial = child.is_object();
    if (!up.radial) {
        reader.read("ground_up", up.direction, -1.0, 1.0);
        if (std::abs(glm::length(up.direction) - 1.0) > 1e-9)
            fail(ErrorKind::input, "{}: is no unit vector", reader.placeOf("ground_up"));
        return;
    }
    SettingsReader centre(child, reader.placeOf("ground_up"));
    centre.read("centre", up.centre, -anyNumber, anyNumber);
    centre.finish();
}

// A mask whose image the field does not hold.
bool hasImage(const std::string& mask)
{
    return mask.starts_with("texture:") || mask.starts_with("raster:");
}

bool hasImages(const Meadow& meadow)
{
    for (const SpeciesTraits& species : meadow.species)
        for (const Mask& mask : species.habitat.masks)
            if (hasImage(textOf(mask)))
                return true;
    return false;
}

void readMasks(SettingsReader& reader, const std::string& place, std::vector<Mask>& masks)
{
    if (!reader.has("masks") || !masks.empty())
        return;
    for (const json& entry : reader.child("masks")) {
        const std::string text = entry.is_string() ? entry.get<std::string>() : std::string();
        if (hasImage(text))
            fail(ErrorKind::input, "{}: was baked with an image as mask: name it by --mask", place);
        const std::optional<Mask> mask = readMask(text);
        if (!mask)
            fail(ErrorKind::input, "{}: is no list of masks", reader.placeOf("masks"));
        masks.push_back(*mask);
    }
}

void readMeadow(SettingsReader& reader, const std::string& place, Meadow& meadow)
{
    if (!reader.has("meadow"))
        return;
    Meadow baked = meadowFromJson(reader.child("meadow"), reader.placeOf("meadow"));
    if (!hasImages(baked))
        meadow = std::move(baked);
    else if (!hasImages(meadow))
        fail(ErrorKind::input,
             "{}: was baked with a meadow whose species have images as masks: name it by --meadow",
             place);
}

void requireGiven(SettingsReader& reader, const char* key, bool isGiven, const std::string& place,
                  const char* what)
{
    if (reader.has(key) && !reader.child(key).empty() && !isGiven)
        fail(ErrorKind::input, "{}: was baked with {}", place, what);
}

} // namespace

BakeSettings bakedSettings(const std::string& provenance, const BakeSettings& given,
                           const std::string& place)
{
    const json object = parseJson(provenance, place + ": provenance");
    const auto found = object.is_object() ? object.find("settings") : object.end();
    if (found == object.end())
        fail(ErrorKind::input, "{}: does not tell with which settings it was baked", place);
    SettingsReader reader(*found, place + ": provenance: settings");
    BakeSettings settings = given;
    settings.density = numberOf(reader, "density");
    settings.spacing = numberOf(reader, "spacing");
    settings.count = wholeOf(reader, "count");
    settings.budget = wholeOf(reader, "budget").value_or(settings.budget);
    settings.seed = wholeOf(reader, "seed").value_or(settings.seed);
    settings.bladeScale.reset();
    if (reader.has("blade_scale") && reader.child("blade_scale").is_number())
        settings.bladeScale = numberOf(reader, "blade_scale");
    readChoice(reader, "sampling", spreads, settings.spread);
    readChoice(reader, "sides", sideNames, settings.sides);
    reader.read("align", settings.align.vertical, 0.0, 1.0);
    readGroundUp(reader, settings.groundUp);
    readRange(reader, "slope", settings.slope);
    readRange(reader, "altitude", settings.altitude);
    readRange(reader, "curvature", settings.curvature);
    readRange(reader, "border", settings.border);
    readRange(reader, "above_water", settings.water);
    readRange(reader, "sky", settings.sky);
    reader.read("min_island", settings.minIsland, 0.0, anyNumber);
    reader.read("clearance", settings.clearance, 0.0, anyNumber);
    reader.read("exposure_rays", settings.exposureRays, 0, 1024);
    reader.read("ray_length", settings.rayLength, 0.0, anyNumber);
    readMasks(reader, place, settings.masks);
    readMeadow(reader, place, settings.meadow);
    requireGiven(reader, "excluded", !given.excluded.empty(), place,
                 "excluded areas: name them by --exclude");
    requireGiven(reader, "paint", !given.strokes.file.empty(), place,
                 "strokes: name their file by --paint");
    reader.finish();
    return settings;
}

} // namespace sward::bake
