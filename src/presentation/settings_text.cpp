#include "presentation/settings_text.h"

#include "core/json/json_text.h"
#include "presentation/environment_settings.h"
#include "presentation/look_settings.h"
#include "render/frame/cull_tests.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>

namespace sward::presentation {

using render::Collider;
using render::FrameSettings;
using render::LevelStep;
using render::WindSource;

namespace {

using Json = nlohmann::ordered_json;

// The shortest number that parses to the same float.
Json number(float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
        if (std::strtof(text, nullptr) == value)
            break;
    }
    return std::strtod(text, nullptr);
}

Json vector(const glm::vec3& v)
{
    return {number(v.x), number(v.y), number(v.z)};
}

Json vector(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

Json windJson(const WindSource& wind)
{
    const render::WindPattern& s = wind.source;
    const bool isRound = s.kind == render::windRadial || s.kind == render::windSwirl;
    Json json{{"kind", windKindName(s.kind)},
              {"strength", number(s.strength)},
              {"size", number(s.size)},
              {"alignment", number(s.alignment)},
              {"lift", number(s.lift)}};
    if (isRound)
        json["centre"] = vector(wind.centre);
    else
        json["direction"] = vector(s.direction);
    if (s.kind == render::windTurning) {
        json["rate"] = number(s.rate);
        json["turn"] = number(s.turn);
    } else {
        json["speed"] = number(s.speed);
    }
    return json;
}

Json colliderJson(const Collider& collider)
{
    Json json;
    if (collider.from == collider.to) {
        json["centre"] = vector(collider.from);
    } else {
        json["from"] = vector(collider.from);
        json["to"] = vector(collider.to);
    }
    json["radius"] = collider.radius;
    for (const Collider::Waypoint& point : collider.path)
        json["path"].push_back({{"time", point.time}, {"move", vector(point.move)}});
    return json;
}

Json detailJson(const FrameSettings& settings)
{
    Json json{{"thin_and_widen", settings.levelOfDetail},
              {"thin_below_px", number(settings.lodThreshold)},
              {"min_width", number(settings.minPixels)},
              {"max_leaf_area", number(settings.maxLeafArea)},
              {"segments", settings.tessellationLevel}};
    if (!settings.levelSteps.empty())
        json["steps"] = Json::array();
    for (const LevelStep& step : settings.levelSteps)
        json["steps"].push_back({{"distance", number(step.distance)}, {"segments", step.segments}});
    if (settings.updateRate.everyFrame)
        json["move_every_frame"] = number(*settings.updateRate.everyFrame);
    if (settings.updateRate.everyThird)
        json["move_every_third"] = number(*settings.updateRate.everyThird);
    return json;
}

} // namespace

std::string settingsText(const FrameSettings& settings)
{
    const field::Defaults& environment = settings.environment;
    Json json;
    json["wind"] = Json::array();
    for (const WindSource& wind : settings.winds)
        json["wind"].push_back(windJson(wind));
    json["gravity"] = {{"direction", vector(environment.gravityDirection)},
                       {"strength", number(environment.gravityStrength)},
                       {"attractor", vector(environment.attractor)},
                       {"blend", number(environment.attractorBlend)},
                       {"forward", number(settings.forward)}};
    json["recovery"] = number(environment.recovery);
    json["colliders"] = Json::array();
    for (const Collider& collider : settings.colliders)
        json["colliders"].push_back(colliderJson(collider));

    Json& culling = json["culling"];
    for (const render::CullTest& test : render::cullTests)
        culling[std::string(test.name)] = (settings.cullMask & test.bit) != 0;
    culling["draw_distance"] = number(environment.drawDistance);
    if (settings.maxEdgeOn)
        culling["edge_on_cosine"] = number(*settings.maxEdgeOn);
    if (settings.buckets.count > 0)
        culling["buckets"] = {{"count", settings.buckets.count},
                              {"distance", number(settings.buckets.distance)}};
    json["detail"] = detailJson(settings);

    const SunPlace sun = sunPlaceOf(settings.sunDirection);
    json["look"] = {{"sun",
                     {{"azimuth", number(static_cast<float>(sun.azimuth))},
                      {"elevation", number(static_cast<float>(sun.elevation))},
                      {"color", vector(settings.sunColor)}}},
                    {"sky", vector(settings.skyColor)},
                    {"ground", vector(settings.groundColor)},
                    {"clouds", number(settings.clouds)},
                    {"thatch", number(settings.thatch)},
                    {"blade_shadows", settings.bladeShadows},
                    {"blade_shadow_distance", number(settings.bladeShadowDistance)},
                    {"fog_height", number(settings.fogHeight)}};
    if (settings.skyUp)
        json["look"]["up"] = vector(*settings.skyUp);
    // If absent, exposure and fog density are chosen from the field.
    if (settings.exposure)
        json["look"]["exposure"] = number(*settings.exposure);
    if (settings.fogDensity >= 0.0f)
        json["look"]["fog"] = number(settings.fogDensity);
    return jsonText(json, 2) + "\n";
}

} // namespace sward::presentation
