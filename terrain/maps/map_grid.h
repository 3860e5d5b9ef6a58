#pragma once

#include "core/diagnostics.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
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
    glm::dvec2 first{0.0};     ///< [m] east and north of the raster's first sample
    glm::dvec2 step{0.0};      ///< [m] from sample to sample, > 0; 0: the file has no place
    glm::dvec2 from{0.0};      ///< whole column and row of the raster at which the values begin

    /// Column and row among the values of a place, which may lie outside. The same place lies
    /// between the same samples, by the same shares, whatever part of a raster is here.
    glm::dvec2 indexOf(glm::dvec2 eastNorth) const
    {
        return glm::dvec2((eastNorth.x - first.x) / step.x, (first.y - eastNorth.y) / step.y) -
               from;
    }
};

/// What asks for the heights of a ground, as an option of readMap().
inline constexpr const char* heightsOption = "heights";

/// Heights of a tile of a large map that is baked within a gigabyte of memory.
inline constexpr double samplesOfTile = 3e6;

/// What is read of a raster.
struct MapRequest {
    int band = 1;                        ///< from 1
    std::vector<double> classes{};       ///< if any, values are names, compared as the file has
                                         ///< them: 1 for these and 0 for others, of the nearest
                                         ///< sample, without scale and offset
    std::optional<std::string> system{}; ///< of the grid, as WKT; unset: the file's own if that is
                                         ///< in metres, else a transverse Mercator at its middle
    std::optional<MapBounds> within{};   ///< only what covers this, in metres of `system`
    std::size_t maxSamples = 0;          ///< read and made; more are refused
    bool mayThin = false; ///< instead, every n-th sample is taken, the least n that suffices
};

/// A band of a GeoTIFF that is read by windows.
class MapRaster {
public:
    MapRaster() = default;
    MapRaster(const MapRaster&) = delete;
    MapRaster& operator=(const MapRaster&) = delete;
    virtual ~MapRaster() = default;

    /// The whole raster, without values.
    virtual const MapGrid& grid() const = 0;

    /// Reads `count` columns and rows from `from` on, row by row. A sample has the same value in
    /// every window. Throws Error{input} if the file is damaged, or turned so far that a window
    /// needs more than 100 million of its samples.
    virtual void read(glm::uvec2 from, glm::uvec2 count, std::span<float> values) = 0;
};

/// Opens a band of a GeoTIFF; `request.within` and maxSamples do not count. Throws as readMap().
std::unique_ptr<MapRaster> openMap(const std::string& path, const MapRequest& request,
                                   const std::string& option, Diagnostics& diagnostics);

/// Reads a band of a GeoTIFF. Values get the band's scale and offset. What lies in another system,
/// is rotated or begins in the south is resampled, bilinearly but for categories, at steps of the
/// file's mean pixel. `option` names what asks for it. Throws Error{io}; Error{input} if the file
/// is damaged, has no such band, no place or no system where one is needed, does not meet
/// `within`, or has no numbers as exact as a class; Error{unsupported} beyond maxSamples, for
/// complex numbers, and without GDAL.
MapGrid readMap(const std::string& path, const MapRequest& request, const std::string& option,
                Diagnostics& diagnostics);

/// Whether this build reads maps.
bool readsMaps();

} // namespace sward::terrain
