#include "render/nature_settings.h"

#include "core/error.h"
#include "core/settings_json.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <string>

namespace sward::render {
namespace {

constexpr double farthest = 1e12;    ///< [m] far beyond the Moon
constexpr double largestSize = 1e9;  ///< [m]
constexpr double quickest = 1e6;     ///< [m/s], [rad/s]
constexpr double strongest = 1000.0; ///< [1/s]
constexpr double longest = 1e9;      ///< [s]

// In the order of shared::windNoise ….
constexpr std::array<const char*, shared::windKinds> kindNames{"noise",  "turning", "wave",
                                                               "radial", "swirl",   "gusts"};

void requireDirection(glm::vec3 v, const std::string& place)
{
    if (!(glm::length(v) > 1e-6f))
        fail(ErrorKind::input, "{}: has no length", place);
}

std::uint32_t kindOf(const std::string& name, const std::string& place)
{
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind)
        if (name == kindNames[kind])
            return kind;
    const std::string near =
        nearestWord(name, std::vector<std::string>(kindNames.begin(), kindNames.end()));
    fail(ErrorKind::input, "{}: \"{}\" is not one of {}{}", place, name, fmt::join(kindNames, ", "),
         near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

// Each kind has its own keys; another's is unknown to it.
WindSource readWind(SettingsReader& reader)
{
    std::string name = kindNames[shared::windNoise];
    reader.read("kind", name);
    const std::uint32_t kind = kindOf(name, reader.placeOf("kind"));
    WindSource wind = windSource(kind);
    shared::WindSource& s = wind.source;
    reader.read("strength", s.strength, 0.0, strongest);
    reader.read("size", s.size, 1e-3, largestSize);
    reader.read("alignment", s.alignment, 0.0, 1.0);
    reader.read("lift", s.lift, 0.0, 1.0);
    const bool isRound = kind == shared::windRadial || kind == shared::windSwirl;
    if (isRound) {
        reader.read("centre", wind.centre, -farthest, farthest);
    } else {
        reader.read("direction", s.direction, -1e6, 1e6);
        requireDirection(s.direction, reader.placeOf("direction"));
    }
    if (kind == shared::windTurning) {
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
    reader.read(isSphere ? "centre" : "from", collider.from, -farthest, farthest);
    collider.to = collider.from;
    if (!isSphere) {
        for (const char* key : {"from", "to"})
            if (!reader.has(key))
                fail(ErrorKind::input, "{}: missing; a sphere has a centre, a capsule from and to",
                     reader.placeOf(key));
        reader.read("to", collider.to, -farthest, farthest);
    }
    reader.read("radius", collider.radius, 1e-6, largestSize);
    if (reader.has("path")) {
        const nlohmann::json& path = reader.child("path");
        if (!path.is_array())
            fail(ErrorKind::input, "{}: expected an array", reader.placeOf("path"));
        for (const nlohmann::json& entry : path) {
            SettingsReader one(entry,
                               fmt::format("{}[{}]", reader.placeOf("path"), collider.path.size()));
            Collider::Waypoint point;
            one.read("time", point.time, -longest, longest);
            one.read("move", point.move, -farthest, farthest);
            one.finish();
            if (!collider.path.empty() && point.time <= collider.path.back().time)
                fail(ErrorKind::input, "{}: {} is not later than the waypoint before",
                     one.placeOf("time"), point.time);
            collider.path.push_back(point);
        }
    }
    reader.finish();
    return collider;
}

// The entries of an array of at most `most` objects.
template <typename Entry, typename Read>
void readList(SettingsReader& reader, const char* key, std::size_t most, std::vector<Entry>& list,
              Read read)
{
    if (!reader.has(key))
        return;
    const nlohmann::json& array = reader.child(key);
    if (!array.is_array())
        fail(ErrorKind::input, "{}: expected an array", reader.placeOf(key));
    if (array.size() > most)
        fail(ErrorKind::input, "{}: {} entries, more than {}", reader.placeOf(key), array.size(),
             most);
    list.clear();
    for (const nlohmann::json& entry : array) {
        SettingsReader one(entry, fmt::format("{}[{}]", reader.placeOf(key), list.size()));
        list.push_back(read(one));
    }
}

} // namespace

void readNature(SettingsReader& reader, FrameSettings& settings)
{
    readList(reader, "wind", shared::maxWindSources, settings.winds, readWind);
    readList(reader, "colliders", shared::maxColliders, settings.colliders, readCollider);
    if (reader.has("gravity")) {
        SettingsReader gravity(reader.child("gravity"), reader.placeOf("gravity"));
        field::Defaults& nature = settings.nature;
        gravity.read("direction", nature.gravityDirection, -1e6, 1e6);
        requireDirection(nature.gravityDirection, gravity.placeOf("direction"));
        gravity.read("strength", nature.gravityStrength, 0.0, strongest);
        gravity.read("attractor", nature.attractor, -farthest, farthest);
        gravity.read("blend", nature.attractorBlend, 0.0, 1.0);
        gravity.read("forward", settings.forward, 0.0, 1.0);
        gravity.finish();
    }
    reader.read("recovery", settings.nature.recovery, 1e-3, strongest);
}

} // namespace sward::render
