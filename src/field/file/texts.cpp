#include "field/file/texts.h"

#include "core/error.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

namespace sward::field {
namespace {

using nlohmann::json;

// Beyond this distance from the world's origin a double does not resolve a millimetre.
constexpr double farthest = 1e12;
constexpr double widestValue = 1e30;

template <typename Vec>
json toArray(const Vec& v)
{
    return json::array({v.x, v.y, v.z});
}

void requireUnit(const glm::vec3& v, const std::string& place)
{
    if (std::abs(glm::length(v) - 1.0f) > 1e-3f)
        fail(ErrorKind::input, "{}: ({}, {}, {}) is not a unit vector", place, v.x, v.y, v.z);
}

} // namespace

std::string speciesText(const std::vector<Species>& species)
{
    json list = json::array();
    for (const Species& one : species) {
        list.push_back({{"name", one.name},
                        {"root_color", toArray(one.look.rootColor)},
                        {"tip_color", toArray(one.look.tipColor)},
                        {"tip_threshold", one.look.tipThreshold},
                        {"ground_tint", one.look.groundTint},
                        {"color_variation", one.look.colorVariation},
                        {"translucency", one.look.translucency},
                        {"gloss", one.look.gloss},
                        {"dryness", one.look.dryness},
                        {"shape", shapeNames[one.look.shape]},
                        {"fold", one.look.fold}});
        if (!one.organs.empty())
            list.back()["organs"] = organsJson(one.organs);
    }
    return jsonText(list);
}

std::vector<Species> parseSpecies(std::string_view text, const std::string& place)
{
    const json list = parseJson(text, place);
    if (!list.is_array() || list.empty() || list.size() > shared::maxSpecies)
        fail(ErrorKind::input, "{}: expected an array of 1 to {} species", place,
             shared::maxSpecies);
    std::vector<Species> result;
    for (const json& entry : list) {
        Species one;
        SettingsReader reader(entry, fmt::format("{}[{}]", place, result.size()));
        reader.read("name", one.name);
        reader.readColor("root_color", one.look.rootColor, 0.0, 1.0);
        reader.readColor("tip_color", one.look.tipColor, 0.0, 1.0);
        reader.read("tip_threshold", one.look.tipThreshold, 0.0, 0.99);
        reader.read("ground_tint", one.look.groundTint, 0.0, 1.0);
        reader.read("color_variation", one.look.colorVariation, 0.0, 1.0);
        reader.read("translucency", one.look.translucency, 0.0, 1.0);
        reader.read("gloss", one.look.gloss, 0.0, 1.0);
        reader.read("dryness", one.look.dryness, 0.0, 1.0);
        one.look.shape = reader.readWord("shape", shapeNames, one.look.shape);
        reader.read("fold", one.look.fold, 0.0, 1.0);
        if (reader.has("organs"))
            one.organs = parseOrgans(reader.child("organs"), reader.placeOf("organs"));
        reader.finish();
        result.push_back(std::move(one));
    }
    numberOrgans(result, place);
    return result;
}

std::string coverText(double thinned)
{
    return thinned == 1.0 ? std::string() : jsonText(json{{"thinned", thinned}});
}

double parseCover(std::string_view text, const std::string& place)
{
    double thinned = 1.0;
    if (text.empty())
        return thinned;
    const json object = parseJson(text, place);
    SettingsReader reader(object, place);
    reader.read("thinned", thinned, 1.0, maxThinned);
    return thinned;
}

std::string defaultsText(const Defaults& defaults, const std::string& copyright)
{
    json cameras = json::array();
    for (const Camera& camera : defaults.cameras)
        cameras.push_back({{"name", camera.name},
                           {"eye", toArray(camera.eye)},
                           {"target", toArray(camera.target)},
                           {"up", toArray(camera.up)},
                           {"fov_y_deg", camera.fovY}});
    const json object = {
        {"wind",
         {{"direction", toArray(defaults.wind.direction)},
          {"strength", defaults.wind.strength},
          {"wave_length", defaults.wind.waveLength},
          {"speed", defaults.wind.speed},
          {"gust_size", defaults.wind.gustSize},
          {"gustiness", defaults.wind.gustiness}}},
        {"gravity",
         {{"direction", toArray(defaults.gravityDirection)},
          {"attractor", toArray(defaults.attractor)},
          {"strength", defaults.gravityStrength},
          {"blend", defaults.attractorBlend}}},
        {"recovery", defaults.recovery},
        {"draw_distance", defaults.drawDistance},
        {"cameras", cameras},
        {"copyright", copyright},
    };
    return jsonText(object);
}

Defaults parseDefaults(std::string_view text, const std::string& place, std::string& copyright)
{
    const json object = parseJson(text, place);
    Defaults result;
    SettingsReader reader(object, place);

    SettingsReader wind(reader.child("wind"), reader.placeOf("wind"));
    wind.read("direction", result.wind.direction, -1.0, 1.0);
    wind.read("strength", result.wind.strength, 0.0, 1000.0);
    wind.read("wave_length", result.wind.waveLength, 1e-6, 1e9);
    wind.read("speed", result.wind.speed, -1e6, 1e6);
    wind.read("gust_size", result.wind.gustSize, 1e-6, 1e9);
    wind.read("gustiness", result.wind.gustiness, 0.0, 1.0);
    wind.finish();
    requireUnit(result.wind.direction, wind.placeOf("direction"));

    SettingsReader gravity(reader.child("gravity"), reader.placeOf("gravity"));
    gravity.read("direction", result.gravityDirection, -1.0, 1.0);
    gravity.read("attractor", result.attractor, -farthest, farthest);
    gravity.read("strength", result.gravityStrength, 0.0, 1000.0);
    gravity.read("blend", result.attractorBlend, 0.0, 1.0);
    gravity.finish();
    requireUnit(result.gravityDirection, gravity.placeOf("direction"));

    reader.read("recovery", result.recovery, 1e-3, 1000.0);
    reader.read("draw_distance", result.drawDistance, 0.0, widestValue);
    reader.read("copyright", copyright);
    const json& cameras = reader.child("cameras");
    if (!cameras.is_array())
        fail(ErrorKind::input, "{}: expected an array", reader.placeOf("cameras"));
    for (const json& entry : cameras) {
        Camera camera;
        SettingsReader one(entry,
                           fmt::format("{}[{}]", reader.placeOf("cameras"), result.cameras.size()));
        one.read("name", camera.name);
        one.read("eye", camera.eye, -farthest, farthest);
        one.read("target", camera.target, -farthest, farthest);
        one.read("up", camera.up, -1.0, 1.0);
        one.read("fov_y_deg", camera.fovY, 0.1, 170.0);
        one.finish();
        result.cameras.push_back(std::move(camera));
    }
    reader.finish();
    return result;
}

} // namespace sward::field
