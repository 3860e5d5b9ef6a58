#pragma once

#include <glm/vec2.hpp>
#include <ogr_srs_api.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

// Coordinate systems, by GDAL. Only sources of this folder may include this.

struct ReleaseSystem {
    void operator()(void* system) const { OSRRelease(static_cast<OGRSpatialReferenceH>(system)); }
};

/// A coordinate system whose axes are east and north, without heights; null: none.
using MapSystem = std::unique_ptr<void, ReleaseSystem>;

/// Makes GDAL ready, silent and without network; its words never reach a user. Call first.
void prepareMaps();

/// Of WKT. Throws Error{input} naming `path` if it means nothing.
MapSystem systemOf(const std::string& wkt, const std::string& path);

/// A copy without heights.
MapSystem systemOf(OGRSpatialReferenceH system);

std::string wktOf(const MapSystem& system);

/// Whether its coordinates are metres on a plane.
bool isInMetres(const MapSystem& system);

/// A whole turn in its longitudes: 360 in degrees; 0 if it has none.
double turnOf(const MapSystem& system);

/// What it is called, as "WGS 84 / UTM zone 33N"; a PROJ string without a name.
std::string nameOf(const MapSystem& system);

bool isSame(const MapSystem& a, const MapSystem& b);

/// A transverse Mercator without scale at a place of `system`: in metres, true to 10⁻⁴ within 90
/// km.
MapSystem localSystem(const MapSystem& system, glm::dvec2 place, const std::string& path);

/// From one system to another; places that have none become infinite.
class MapChange {
public:
    /// The same place if both are the same. Throws Error{input} naming `path` if there is no way.
    MapChange(const MapSystem& from, const MapSystem& to, const std::string& path);
    ~MapChange();
    MapChange(const MapChange&) = delete;
    MapChange& operator=(const MapChange&) = delete;

    void apply(std::vector<glm::dvec2>& places) const;
    glm::dvec2 at(glm::dvec2 place) const;
    OGRCoordinateTransformationH handle() const { return change_; } ///< null: the same place

private:
    OGRCoordinateTransformationH change_ = nullptr;
};

} // namespace sward::terrain
