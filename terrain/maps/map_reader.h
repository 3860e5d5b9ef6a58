#pragma once

#include "terrain/maps/map_places.h"
#include "terrain/maps/map_shapes.h"

namespace sward::terrain {

/// What the library sward_maps does, which alone links GDAL and some hundred libraries behind it:
/// programs open it when a map is read or placed. Its functions are readMap(), openMap(),
/// readMapShapes(), mapSystemFacts(), and degreesOf() and mapPlacesOf() in one.
struct MapReader {
    MapGrid (*readMap)(const std::string& path, const MapRequest& request,
                       const std::string& option, Diagnostics& diagnostics);
    std::unique_ptr<MapRaster> (*openMap)(const std::string& path, const MapRequest& request,
                                          const std::string& option, Diagnostics& diagnostics);
    std::shared_ptr<const MapShapes> (*readShapes)(const std::string& path, double margin,
                                                   const std::string& system,
                                                   Diagnostics& diagnostics);
    MapSystemFacts (*systemFacts)(const std::string& system, const std::string& option);
    std::vector<glm::dvec2> (*changedPlaces)(const std::string& system,
                                             std::vector<glm::dvec2> places, bool toDegrees,
                                             const std::string& option);
};

/// By GDAL, inside that library; as readMap(), openMap() and readMapShapes().
MapGrid readMapByGdal(const std::string& path, const MapRequest& request, const std::string& option,
                      Diagnostics& diagnostics);
std::unique_ptr<MapRaster> openMapByGdal(const std::string& path, const MapRequest& request,
                                         const std::string& option, Diagnostics& diagnostics);
std::shared_ptr<const MapShapes> readShapesByGdal(const std::string& path, double margin,
                                                  const std::string& system,
                                                  Diagnostics& diagnostics);
MapSystemFacts mapSystemFactsByGdal(const std::string& system, const std::string& option);
std::vector<glm::dvec2> changedPlacesByGdal(const std::string& system,
                                            std::vector<glm::dvec2> places, bool toDegrees,
                                            const std::string& option);

/// Name of the function that returns the library's MapReader; changes with what it holds.
inline constexpr const char* mapReaderName = "sward_map_reader_3";

} // namespace sward::terrain
