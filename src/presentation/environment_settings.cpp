#include "presentation/environment_settings.h"

#include "core/error.h"
#include "core/json/settings_json.h"
#include "presentation/settings_list.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <string_view>

namespace sward::presentation {

using render::Collider;
using render::FrameSettings;
using render::WindSource;

namespace {

constexpr double farthestDraw = 1e12; ///< [m] beyond the Moon
constexpr double largestSize = 1e9;   ///< [m]
constexpr double quickest = 1e6;      ///< [m/s], [rad/s]
constexpr double strongest = 1000.0;  ///< [1/s]
constexpr double longest = 1e9;       ///< [s]
constexpr std::size_t maxWaypoints = 1u << 16;

// In the order of render::windNoise ….
constexpr std::array<std::string_view, render::windKinds> kindNames{"noise",  "turning", "wave",
                                                                    "radial", "swirl",   "gusts"};

void requireDirection(glm::vec3 v, const std::string& place)
{
    if (!(glm::length(v) > 1e-6f))
        fail(ErrorKind::input, "{}: has no length", place);
}

// Each kind has its own keys; keys of other kinds are rejected.
WindSource readWind(SettingsReader& reader)
{
    const std::uint32_t kind = reader.readWord("kind", kindNames, render::windNoise);
    WindSource wind = render::windSource(kind);
    render::WindPattern& s = wind.source;
    reader.read("strength", s.strength, 0.0, strongest);
    reader.read("size", s.size, 1e-3, largestSize);
    reader.read("alignment", s.alignment, 0.0, 1.0);
    reader.read("lift", s.lift, 0.0, 1.0);
    const bool isRound = kind == render::windRadial || kind == render::windSwirl;
    if (isRound) {
        reader.read("centre", wind.centre, -farthestDraw, farthestDraw);
    } else {
        reader.read("direction", s.direction, -1e6, 1e6);
        requireDirection(s.direction, reader.placeOf("direction"));
    }
    if (kind == render::windTurning) {
        reader.read("rate", s.rate, -quickest, quickest);
        reader.read("turn", s.turn, -quickest, quickest);
    } else {
        reader.read("speed", s.speed, -quickest, quickest);
    }
    reader.finish();
    return wind;
}

Collider readCollider(SettingsReader& reader)
{
    Collider collider;
    const bool isSphere = reader.has("centre");
    reader.read(isSphere ? "centre" : "from", collider.from, -farthestDraw, farthestDraw);
    collider.to = collider.from;
    if (!isSphere) {
        for (const char* key : {"from", "to"})
            if (!reader.has(key))
                fail(ErrorKind::input, "{}: missing; a sphere has a centre, a capsule from and to",
                     reader.placeOf(key));
        reader.read("to", collider.to, -farthestDraw, farthestDraw);
    }
    reader.read("radius", collider.radius, 1e-6, largestSize);
    readList(reader, "path", maxWaypoints, collider.path, [&collider](SettingsReader& one) {
        Collider::Waypoint point;
        one.read("time", point.time, -longest, longest);
        one.read("move", point.move, -farthestDraw, farthestDraw);
        if (!collider.path.empty() && point.time <= collider.path.back().time)
            fail(ErrorKind::input, "{}: {} is not later than the waypoint before",
                 one.placeOf("time"), point.time);
        one.finish();
        return point;
    });
    reader.finish();
    return collider;
}

} // namespace

std::string_view windKindName(std::uint32_t kind)
{
    return kindNames.at(kind);
}

void readEnvironment(SettingsReader& reader, FrameSettings& settings)
{
    readList(reader, "wind", render::maxWindSources, settings.winds, readWind);
    readList(reader, "colliders", render::maxColliders, settings.colliders, readCollider);
    if (reader.has("gravity")) {
        SettingsReader gravity(reader.child("gravity"), reader.placeOf("gravity"));
        field::Defaults& environment = settings.environment;
        gravity.read("direction", environment.gravityDirection, -1e6, 1e6);
        requireDirection(environment.gravityDirection, gravity.placeOf("direction"));
        gravity.read("strength", environment.gravityStrength, 0.0, strongest);
        gravity.read("attractor", environment.attractor, -farthestDraw, farthestDraw);
        gravity.read("blend", environment.attractorBlend, 0.0, 1.0);
        gravity.read("forward", settings.forward, 0.0, 1.0);
        gravity.finish();
    }
    reader.read("recovery", settings.environment.recovery, 1e-3, strongest);
}

} // namespace sward::presentation
