#pragma once

#include "core/diagnostics.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

// Maps lie in coordinate systems of the Earth. Sward's world has x to the east, y up and z to the
// south: (east, north) is (x, −z). GDAL reads files and knows the systems; a build without it
// refuses every map with Error{unsupported}.

/// A rectangle of a map, in metres of its system.
struct MapBounds {
    glm::dvec2 low{0.0};  ///< west, south
    glm::dvec2 high{0.0}; ///< east, north
};

/// Samples of a band of a raster, north up.
struct MapGrid {
    std::string system;        ///< coordinate system as WKT; empty if the file names none
    glm::uvec2 size{0U};       ///< columns to the east, rows to the south
    std::vector<float> values; ///< row by row from the north-west; NaN: no data
    glm::dvec2 first{0.0};     ///< [m] east and north of the first sample
    glm::dvec2 step{0.0};      ///< [m] from sample to sample, > 0; 0: the file has no place

    /// Index of the column and row nearest to a place, which may lie outside.
    glm::dvec2 indexOf(glm::dvec2 eastNorth) const
    {
        return {(eastNorth.x - first.x) / step.x, (first.y - eastNorth.y) / step.y};
    }
};

/// What is read of a raster.
struct MapRequest {
    int band = 1;            ///< from 1
    bool isCategory = false; ///< values are names: nearest sample, no scale and no offset
    std::optional<std::string> system{}; ///< of the grid, as WKT; unset: the file's own if that is
                                         ///< in metres, else a transverse Mercator at its middle
    std::optional<MapBounds> within{};   ///< only what covers this, in metres of `system`
    std::size_t maxSamples = 0;          ///< read and made; more are refused
};

/// Reads a band of a GeoTIFF. Values get the band's scale and offset. What lies in another system,
/// is rotated or begins in the south is resampled, bilinearly but for categories, at steps of the
/// file's mean pixel. `option` names what asks for it. Throws Error{io}; Error{input} if the file
/// is damaged, has no such band, no place or no system where one is needed, or does not meet
/// `within`; Error{unsupported} beyond maxSamples, for complex numbers, and without GDAL.
MapGrid readMap(const std::string& path, const MapRequest& request, const std::string& option,
                Diagnostics& diagnostics);

/// Whether this build reads maps.
bool readsMaps();

} // namespace sward::terrain
