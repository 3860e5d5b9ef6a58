#pragma once

#include "terrain/maps/map_grid.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::terrain {

/// Whether a file holds shapes of a map, by its extension: .geojson .gpkg .shp.
bool isMapShapes(const std::string& path);

/// Areas of a map. Thread-safe once made.
class MapShapes {
public:
    /// Corners of a ring, [m] east and north; the last one is the first again.
    using Ring = std::vector<glm::dvec2>;

    /// Of areas of rings each: a place in an odd number of an area's rings is inside it.
    explicit MapShapes(const std::vector<std::vector<Ring>>& areas);

    /// Whether a place lies in one of them.
    bool holds(glm::dvec2 eastNorth) const;

    /// Where they lie; low > high without any.
    MapBounds bounds() const { return bounds_; }

private:
    struct Edge {
        glm::dvec2 from, to;
        std::uint32_t area;
    };

    std::size_t bandOf(double north) const;

    MapBounds bounds_{glm::dvec2(1e300), glm::dvec2(-1e300)};
    std::vector<Edge> edges_;          ///< of all bands, by band and by area
    std::vector<std::size_t> firstOf_; ///< of each band, and the end
};

/// Reads all areas of a file, and lines and points, widened by `margin` [m], in metres of `system`
/// (WKT; empty: the file's own must be in metres). Throws Error{io}; Error{input} if the file is
/// damaged, has no system where `system` has one, is in degrees where that has none, or has lines
/// and no margin; Error{unsupported} without GDAL.
std::shared_ptr<const MapShapes> readMapShapes(const std::string& path, double margin,
                                               const std::string& system, Diagnostics& diagnostics);

} // namespace sward::terrain
