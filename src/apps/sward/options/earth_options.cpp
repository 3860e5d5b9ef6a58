#include "apps/sward/options/earth_options.h"

#include "apps/common/parse_text.h"
#include "core/error.h"
#include "terrain/maps/map_places.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::apps {
namespace {

// --crs without a system.
constexpr std::string_view noSystem = "none";

// A place may lie this far outside of a system's area of use [°]: neighbours of a zone are often
// mapped in it.
constexpr double areaMargin = 0.5;

bool liesIn(const terrain::MapBounds& area, const glm::dvec2& degrees)
{
    if (degrees.y < area.low.y - areaMargin || degrees.y > area.high.y + areaMargin)
        return false;
    // From the western edge to the east; areas may reach across 180°.
    const auto eastOf = [&](double longitude) {
        return std::fmod(longitude - area.low.x + areaMargin + 720.0, 360.0);
    };
    const double width = area.high.x - area.low.x;
    return width >= 360.0 - 2.0 * areaMargin ||
           eastOf(degrees.x) <= std::fmod(width + 360.0, 360.0) + 2.0 * areaMargin;
}

void requireArea(const terrain::MapSystemFacts& facts, const glm::dvec2& degrees, ErrorKind kind,
                 const std::string& what)
{
    if (!std::isfinite(degrees.x) || !std::isfinite(degrees.y))
        fail(kind, "{}: nowhere on the Earth in {}", what, facts.name);
    if (!facts.area || liesIn(*facts.area, degrees))
        return;
    fail(kind,
         "{}: longitude {:.4f}, latitude {:.4f} lies outside of the area of {}, longitudes {:g} to "
         "{:g} and latitudes {:g} to {:g}",
         what, degrees.x, degrees.y, facts.name, facts.area->low.x, facts.area->high.x,
         facts.area->low.y, facts.area->high.y);
}

} // namespace

void EarthOptions::add(CLI::App& app)
{
    app.add_option("--at", at_,
                   "With --tiles: longitude and latitude (degrees, WGS84) and height above the "
                   "ellipsoid (metres) of the world's origin; X then points to the east, -Z to "
                   "the north")
        ->type_name("LON,LAT,H");
    app.add_option("--crs", crs_,
                   "With --tiles: coordinate system whose east, north the world's X, -Z are, as "
                   "EPSG:25833; with --at from there, else from its own origin; or none. Default: "
                   "that of the map the field was baked from")
        ->type_name("EPSG:N");
    app.add_option("--geoid", geoid_,
                   "With a map: height of the geoid above the ellipsoid (metres), added to heights "
                   "above the sea")
        ->type_name("M");
}

bool EarthOptions::isGiven() const
{
    return !at_.empty() || !crs_.empty() || !geoid_.empty();
}

void EarthOptions::check(const std::string& output) const
{
    place();
    if (!geoid_.empty())
        parseNumber("--geoid", geoid_, -200.0, 200.0);
    if (!geoid_.empty() && (!at_.empty() || crs_ == noSystem))
        fail(ErrorKind::usage,
             "{}: --geoid shifts the heights of a map; with --at, H is the height of the world's "
             "origin above the ellipsoid",
             output);
    if (!crs_.empty() && crs_ != noSystem)
        terrain::mapSystemFacts(crs_, "--crs");
}

std::optional<interchange::Geodetic> EarthOptions::place() const
{
    if (at_.empty())
        return std::nullopt;
    const std::vector<std::string_view> parts = splitText(at_, ',');
    if (parts.size() != 3)
        fail(ErrorKind::usage, "--at is \"{}\"; expected LON,LAT,H", at_);
    return interchange::Geodetic{.longitude = parseNumber("--at", parts[0], -180.0, 180.0),
                                 .latitude = parseNumber("--at", parts[1], -90.0, 90.0),
                                 .height = parseNumber("--at", parts[2], -1e5, 1e6)};
}

// What --crs names; or the map of the field, unless --at says that its own axes are meant.
std::string EarthOptions::systemOf(const field::FieldView& field) const
{
    if (!crs_.empty())
        return crs_ == noSystem ? std::string() : crs_;
    const nlohmann::json baked = nlohmann::json::parse(*field.provenance, nullptr, false);
    if (!at_.empty() || !baked.is_object() || !baked.contains("map_system") ||
        !baked["map_system"].is_string())
        return {};
    return baked["map_system"].get<std::string>();
}

std::optional<interchange::MapToEarth> EarthOptions::map(const field::FieldView& field) const
{
    const std::string system = systemOf(field);
    if (system.empty()) {
        if (!geoid_.empty())
            fail(ErrorKind::usage, "--geoid needs --crs: the field was baked from no map");
        return std::nullopt;
    }
    const std::string option =
        crs_.empty() ? "the field's map (--crs none leaves it out)" : "--crs";
    const terrain::MapSystemFacts facts = terrain::mapSystemFacts(system, option);
    interchange::MapToEarth map{.name = facts.name, .degreesOf = {}, .height = 0.0};
    glm::dvec2 start(0.0);
    if (const std::optional<interchange::Geodetic> at = place()) {
        const glm::dvec2 degrees(at->longitude, at->latitude);
        requireArea(facts, degrees, ErrorKind::usage, "--at");
        start = terrain::mapPlacesOf(system, {degrees}, option).front();
        map.height = at->height;
    } else if (!geoid_.empty()) {
        map.height = parseNumber("--geoid", geoid_, -200.0, 200.0);
    }
    map.degreesOf = [system, start, option](std::vector<glm::dvec2> places) {
        for (glm::dvec2& place : places)
            place += start;
        return terrain::degreesOf(system, std::move(places), option);
    };
    const glm::dvec3 middle = field.origin + glm::dvec3(field.bounds().centre());
    requireArea(facts, map.degreesOf({glm::dvec2(middle.x, -middle.z)}).front(), ErrorKind::input,
                "the middle of the field");
    return map;
}

} // namespace sward::apps
