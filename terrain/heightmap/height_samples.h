#pragma once

#include "core/diagnostics.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/maps/map_grid.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Heightmap samples, row by row from the upper left corner. NaN: no height there.
struct HeightSamples {
    glm::uvec2 size{0U};
    std::vector<float> values;
    double full = 1.0;       ///< highest value of the format
    bool isMetric = false;   ///< the values are metres already
    bool isEncoded = false;  ///< they were colours
    glm::dvec2 step{0.0};    ///< [m] from sample to sample along x and z, if the file tells; else 0
    glm::dvec2 middle{0.0};  ///< [m] x and z in the world, if the file tells
    bool hasPlace = false;   ///< GroundMesh::hasPlace
    std::string mapSystem{}; ///< GroundMesh::mapSystem
};

/// How a colour stands for a height.
enum class HeightEncoding {
    none,      ///< the brightest channel is the height
    terrarium, ///< red·256 + green + blue/256 − 32768 m (Mapzen, AWS Terrain Tiles)
    terrainRgb ///< (red·65536 + green·256 + blue)/10 − 10000 m (Mapbox Terrain-RGB)
};

/// The encoding "terrarium" or "terrain-rgb"; "" is none. Throws Error{usage} naming `place`.
HeightEncoding heightEncodingOf(const std::string& name, const std::string& place);

/// Most samples on a side of a heightmap.
inline constexpr std::uint32_t heightmapSideLimit = 32768;

// Each function throws Error{input} for a damaged file or a size out of bounds (2 samples to
// heightmapSideLimit per side, heightPointLimit in total), before allocating memory of that size.

/// A PNG of any depth and kind: heights by `encoding`. What is transparent (less than half opaque)
/// becomes a hole; all of it at once is ignored, with a warning.
HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             HeightEncoding encoding, Diagnostics& diagnostics);

/// Samples without a header, 16 bits each, or 32 bits as floats in metres. Throws Error{usage}
/// naming --size if `size` is missing or does not match the file. Warns if neighbours say that the
/// other byte order is right.
struct RawLayout {
    bool isBigEndian = false;
    bool isFloat = false;
};
HeightSamples readRawHeights(std::span<const std::byte> file, const std::optional<glm::uvec2>& size,
                             const RawLayout& layout, const std::string& place,
                             Diagnostics& diagnostics);

/// A tile of SRTM (.hgt), square or 1801 x 3601: big-endian, signed, in metres, a degree along each
/// side. `name` tells its latitude if it begins as N60E010 does.
HeightSamples readHgtHeights(std::span<const std::byte> file, const std::string& place,
                             std::string_view name, Diagnostics& diagnostics);

/// An ESRI ASCII grid (.asc), in metres.
HeightSamples readAscHeights(std::string_view file, const std::string& place,
                             Diagnostics& diagnostics);

/// Length [m] of a degree of longitude at a latitude [degrees] on the ellipsoid of WGS 84.
double metresOfLongitude(double latitude);

/// Length [m] of a degree along a meridian: 3600 times 30.87 m.
inline constexpr double metresOfLatitude = 3600.0 * 30.87;

/// Highest less lowest sample; 0 without any.
double reliefOf(const HeightSamples& samples);

/// Whether a sample of metres stands for no height, as dropNoData() takes it.
bool isNoHeight(float value);

/// Sets samples of metres that are not finite, farther than 1000 km from 0, or −9999, −32767,
/// −32768 or −99999 to NaN, with a warning.
void dropNoData(HeightSamples& samples, const std::string& place, Diagnostics& diagnostics);

/// Warns of a value of many samples that stand in cliffs around them: probably no data.
void hintAtNoData(const HeightSamples& samples, const std::string& place, Diagnostics& diagnostics);

/// Warns if samples use few of the values that their format has: bytes in 16-bit words, a small
/// part of the range, heights from 0 to 1 in metres.
void hintAtFewHeights(const HeightSamples& samples, const std::string& place,
                      Diagnostics& diagnostics);

/// The grid of a map's samples: x to the east and z to the south, by its place, else a metre from
/// sample to sample around the origin.
HeightGrid placeOf(const MapGrid& map);

/// The first band of a GeoTIFF, in metres of `system`, or of its map if that is empty
/// (maps/map_grid.h).
HeightSamples readMapHeights(const std::string& path, const std::string& system,
                             Diagnostics& diagnostics);

/// One channel of an OpenEXR image: Y, else Z, R, height, else the first. Non-finite values, common
/// no-data values and samples whose channel A is below 0.5 become NaN; A below 0.5 everywhere is
/// ignored, with a warning. Throws Error{unsupported} for deep images.
HeightSamples readExrHeights(std::span<const std::byte> file, const std::string& place,
                             Diagnostics& diagnostics);

/// Throws Error{input} naming `place` and the bound if the size is not allowed for a heightmap.
/// `least` is the minimum number of samples per side.
void requireHeightmapSize(std::uint64_t width, std::uint64_t height, const std::string& place,
                          std::uint64_t least = 2);

} // namespace sward::terrain
