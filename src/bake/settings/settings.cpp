#include "bake/settings/settings.h"

#include "bake/settings/meadow_json.h"
#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "terrain/load.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace sward::bake {
namespace {

using nlohmann::json;

double parseNumber(const std::string& option, const std::string& text)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fail(ErrorKind::usage, "{}: \"{}\" is not a number", option, text);
    return value;
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

const char* nameOf(Spread spread)
{
    switch (spread) {
    case Spread::poisson:
        return "poisson";
    case Spread::poissonDense:
        return "poisson-dense";
    case Spread::uniform:
        break;
    }
    return "uniform";
}

void requireRange(const char* name, double value, double low, double high)
{
    if (!(value >= low && value <= high))
        fail(ErrorKind::usage, "{} is {}, outside [{}, {}]", name, value, low, high);
}

// Replaces a mask's file name by the hash of its content.
Mask byContent(Mask mask)
{
    if (mask.image != nullptr)
        mask.file = terrain::contentHash(*mask.image);
    if (mask.map != nullptr)
        mask.file = terrain::mapFileHash(mask.file);
    return mask;
}

json provenanceOf(const ExcludedArea& area)
{
    return {{"mesh", area.mesh != nullptr  ? terrain::contentHash(*area.mesh)
                     : area.map != nullptr ? terrain::mapFileHash(area.file)
                                           : area.file},
            {"margin", area.margin}};
}

} // namespace

glm::dvec3 GroundUp::at(glm::dvec3 place) const
{
    if (!radial)
        return direction;
    const glm::dvec3 outward = place - centre;
    const double length = std::sqrt(glm::dot(outward, outward));
    return length > 0.0 ? outward / length : glm::dvec3(0.0, 1.0, 0.0);
}

double GroundUp::altitude(glm::dvec3 place) const
{
    const glm::dvec3 outward = place - centre;
    return radial ? std::sqrt(glm::dot(outward, outward)) : glm::dot(place, direction);
}

void validate(const BakeSettings& settings)
{
    if (int(settings.density.has_value()) + int(settings.count.has_value()) +
            int(settings.spacing.has_value()) >
        1)
        fail(ErrorKind::usage, "--density, --spacing and --count exclude one another");
    if (settings.spacing) {
        requireRange("--spacing", *settings.spacing, 1e-9, 1e9);
        if (settings.spread == Spread::uniform)
            fail(ErrorKind::usage, "--spacing {} needs --sampling poisson or poisson-dense",
                 *settings.spacing);
    }
    if (settings.density)
        requireRange("--density", *settings.density, 0.0, 1e15);
    if (settings.count)
        requireRange("--count", double(*settings.count), 0.0, 4e9);
    requireRange("--budget", double(settings.budget), 1.0, 4e9);
    requireRange("--max-blades", double(settings.maxBlades), 0.0, 4e9);
    if (settings.bladeScale)
        requireRange("--blade-scale", *settings.bladeScale, 1e-6, 1e5);
    requireRange("--clearance", settings.clearance, 0.0, 1e9);
    requireRange("--sky-rays", settings.exposureRays, 0, 1024);
    requireRange("--ray-length", settings.rayLength, 0.0, 1e9);
    requireRange("--min-island", settings.minIsland, 0.0, 1e300);
    if (!settings.sky.holds(0.0, 1.0) && settings.exposureRays == 0)
        fail(ErrorKind::usage, "--sky needs rays, but --sky-rays is 0");
    if (settings.meadow.species.empty())
        fail(ErrorKind::usage, "the meadow has no species");
}

std::string toJson(const BakeSettings& settings)
{
    json masks = json::array();
    for (const Mask& mask : settings.masks)
        masks.push_back(textOf(byContent(mask)));
    Meadow named = settings.meadow;
    for (SpeciesTraits& species : named.species)
        for (Mask& mask : species.habitat.masks)
            mask = byContent(mask);
    json excluded = json::array();
    for (const ExcludedArea& area : settings.excluded)
        excluded.push_back(provenanceOf(area));
    const auto range = [](const SoftRange& r) { return json::array({r.low, r.high, r.soft}); };
    const auto vector = [](const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); };
    const char* const sides[] = {"front", "back", "both"};
    json object = {
        {"density", settings.density ? json(*settings.density) : json()},
        {"count", settings.count ? json(*settings.count) : json()},
        {"budget",
         settings.density || settings.count || settings.spacing ? json() : json(settings.budget)},
        {"blade_scale", settings.bladeScale ? json(*settings.bladeScale) : json("auto")},
        {"spacing", settings.spacing ? json(*settings.spacing) : json()},
        {"sampling", nameOf(settings.spread)},
        {"seed", settings.seed},
        {"sides", sides[static_cast<int>(settings.sides)]},
        {"align", settings.align.vertical},
        {"ground_up", settings.groundUp.radial ? json{{"centre", vector(settings.groundUp.centre)}}
                                               : vector(settings.groundUp.direction)},
        {"slope", range(settings.slope)},
        {"altitude", range(settings.altitude)},
        {"curvature", range(settings.curvature)},
        {"border", range(settings.border)},
        {"above_water", range(settings.water)},
        {"sky", range(settings.sky)},
        {"min_island", settings.minIsland},
        {"clearance", settings.clearance},
        {"exposure_rays", settings.exposureRays},
        {"ray_length", settings.rayLength},
        {"masks", masks},
        {"excluded", excluded},
        {"meadow", meadowToJson(named)},
    };
    if (!settings.strokes.empty())
        object["paint"] = {{"strokes", settings.strokes.list.size()},
                           {"hash", hashOf(settings.strokes)}};
    return jsonText(object, 2);
}

Alignment parseAlignment(const std::string& text)
{
    if (text == "normal")
        return {0.0};
    if (text == "vertical")
        return {1.0};
    if (text.starts_with("blend:")) {
        const double share = parseNumber("--align", text.substr(6));
        requireRange("--align blend", share, 0.0, 1.0);
        return {share};
    }
    fail(ErrorKind::usage, "--align is \"{}\"; expected normal, vertical or blend:F", text);
}

GroundUp parseGroundUp(const std::string& text)
{
    GroundUp up;
    const std::string axis = text.starts_with("-") ? text.substr(1) : text;
    if (axis.size() == 1 && axis[0] >= 'x' && axis[0] <= 'z') {
        up.direction = glm::dvec3(0.0);
        up.direction[static_cast<std::size_t>(axis[0] - 'x')] = text[0] == '-' ? -1.0 : 1.0;
        return up;
    }
    if (text != "radial" && !text.starts_with("radial:"))
        fail(ErrorKind::usage,
             "--ground-up is \"{}\"; expected x, y, z, -x, -y, -z, radial or radial:x,y,z", text);
    up.radial = true;
    if (text.size() > 7) {
        const std::vector<std::string> parts = split(text.substr(7), ',');
        if (parts.size() != 3)
            fail(ErrorKind::usage, "--ground-up is \"{}\"; radial takes three numbers", text);
        for (std::size_t i = 0; i < 3; ++i)
            up.centre[int(i)] = parseNumber("--ground-up", parts[i]);
    }
    return up;
}

Spread parseSpread(const std::string& text)
{
    for (const Spread spread : {Spread::uniform, Spread::poisson, Spread::poissonDense})
        if (text == nameOf(spread))
            return spread;
    fail(ErrorKind::usage, "--sampling is \"{}\"; expected uniform, poisson or poisson-dense",
         text);
}

SeedUse parseSeedUse(const std::string& text)
{
    if (text == "never")
        return SeedUse::never;
    if (text == "auto")
        return SeedUse::automatic;
    if (text == "always")
        return SeedUse::always;
    fail(ErrorKind::usage, "--seeds is \"{}\"; expected auto, always or never", text);
}

Sides parseSides(const std::string& text)
{
    if (text == "front")
        return Sides::front;
    if (text == "back")
        return Sides::back;
    if (text == "both")
        return Sides::both;
    fail(ErrorKind::usage, "--sides is \"{}\"; expected front, back or both", text);
}

terrain::MaskInputs maskInputs(const BakeSettings& settings)
{
    std::vector<Mask> masks = settings.masks;
    for (const SpeciesTraits& species : settings.meadow.species)
        masks.insert(masks.end(), species.habitat.masks.begin(), species.habitat.masks.end());
    return inputsOf(masks);
}

void loadMaskImages(BakeSettings& settings)
{
    loadImages(settings.masks);
    for (SpeciesTraits& species : settings.meadow.species)
        loadImages(species.habitat.masks);
}

bool needsGreen(const BakeSettings& settings)
{
    Habitat everybody;
    everybody.masks = settings.masks;
    return everybody.needsGreen() ||
           std::any_of(settings.meadow.species.begin(), settings.meadow.species.end(),
                       [](const SpeciesTraits& one) { return one.habitat.needsGreen(); });
}

bool masksByVertexColor(const BakeSettings& settings)
{
    const auto isColor = [](const Mask& mask) { return mask.source == Mask::Source::vertexColor; };
    const auto some = [&](const std::vector<Mask>& masks) {
        return std::any_of(masks.begin(), masks.end(), isColor);
    };
    return some(settings.masks) ||
           std::any_of(settings.meadow.species.begin(), settings.meadow.species.end(),
                       [&](const SpeciesTraits& species) { return some(species.habitat.masks); });
}

} // namespace sward::bake
