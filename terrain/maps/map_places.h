#pragma once

#include "terrain/maps/map_grid.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

// Places of a map on the Earth. A coordinate system is WKT, a name of an authority ("EPSG:25833"),
// or a PROJ string ("+proj=…"). Nothing is fetched from a network.

/// What is known of a coordinate system whose coordinates are metres on a plane.
struct MapSystemFacts {
    std::string name;              ///< as "WGS 84 / UTM zone 33N"
    std::optional<MapBounds> area; ///< of use, [°] longitude and latitude; west > east: across 180°
};

/// Throws Error{usage} naming `option` and the text if no such system is known, or if its
/// coordinates are no metres on a plane; Error{unsupported} without GDAL.
MapSystemFacts mapSystemFacts(const std::string& system, const std::string& option);

/// Longitudes and latitudes [°, WGS84] of places of `system` [m, east and north], all by one
/// operation of PROJ; infinite where a place has none. Throws as mapSystemFacts() does.
std::vector<glm::dvec2> degreesOf(const std::string& system, std::vector<glm::dvec2> places,
                                  const std::string& option);

/// The inverse of degreesOf().
std::vector<glm::dvec2> mapPlacesOf(const std::string& system, std::vector<glm::dvec2> degrees,
                                    const std::string& option);

/// A short name of a system, "EPSG:25833" if its WKT ends in one, else its WKT; empty for none.
std::string systemName(const std::string& wkt);

} // namespace sward::terrain
