#include "core/error.h"
#include "terrain/heightmap/height_samples.h"

#include <cmath>
#include <numbers>

namespace sward::terrain {
namespace {

constexpr double farthestLatitude = 89.0; // a degree of longitude vanishes at the pole

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

// The latitude of a tile's southern edge by a name such as N60E010 or s34e018.
std::optional<double> latitudeOf(std::string_view name)
{
    constexpr std::size_t letters = 7;
    const auto isOneOf = [&](std::size_t at, std::string_view known) {
        return known.find(name[at]) != std::string_view::npos;
    };
    if (name.size() < letters || !isOneOf(0, "NSns") || !isOneOf(3, "EWew"))
        return std::nullopt;
    for (const std::size_t at : {1U, 2U, 4U, 5U, 6U})
        if (!isDigit(name[at]))
            return std::nullopt;
    if (name.size() > letters && isDigit(name[letters]))
        return std::nullopt;
    const double degrees = 10.0 * (name[1] - '0') + (name[2] - '0');
    if (degrees > farthestLatitude)
        return std::nullopt;
    return isOneOf(0, "Ss") ? -degrees : degrees;
}

} // namespace

double metresOfLongitude(double latitude)
{
    constexpr double radius = 6378137.0; // [m] of the equator
    constexpr double squash = 6.69437999014e-3; // squared eccentricity
    const double angle = latitude * std::numbers::pi / 180.0;
    const double sine = std::sin(angle);
    return std::numbers::pi / 180.0 * radius * std::cos(angle) /
           std::sqrt(1.0 - squash * sine * sine);
}

namespace {

// A square, or half as many columns as tiles of an arc second have north of 50 degrees.
glm::uvec2 tileSize(std::size_t bytes, const std::string& place)
{
    constexpr glm::uvec2 halved(1801U, 3601U);
    if (bytes == std::size_t(2) * halved.x * halved.y)
        return halved;
    std::uint32_t side = 0;
    while (std::uint64_t(side + 1) * (side + 1) <= bytes / 2 && side < heightmapSideLimit)
        ++side;
    if (std::uint64_t(side) * side * 2 != bytes)
        fail(ErrorKind::input,
             "{}: {} bytes are no square of 16-bit samples, nor {} x {}; a tile of SRTM has 1201 "
             "or 3601 a side",
             place, bytes, halved.x, halved.y);
    requireHeightmapSize(side, side, place);
    return {side, side};
}

} // namespace

HeightSamples readHgtHeights(std::span<const std::byte> file, const std::string& place,
                             std::string_view name, Diagnostics& diagnostics)
{
    const std::size_t count = file.size() / 2;
    HeightSamples samples;
    samples.size = tileSize(file.size(), place);
    samples.isMetric = true;
    samples.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const unsigned word = std::to_integer<unsigned>(file[2 * i]) << 8 |
                              std::to_integer<unsigned>(file[2 * i + 1]);
        samples.values.push_back(
            static_cast<float>(static_cast<std::int16_t>(static_cast<std::uint16_t>(word))));
    }
    dropNoData(samples, place, diagnostics);

    // A tile is a degree along each side.
    const std::optional<double> latitude = latitudeOf(name);
    const glm::dvec2 extent(latitude ? metresOfLongitude(*latitude) : metresOfLatitude,
                            metresOfLatitude);
    samples.step = extent / glm::dvec2(samples.size - 1U);
    if (latitude)
        diagnostics.warn("{}: its name tells the latitude {}: a degree is {:.0f} x {:.0f} m there; "
                         "--extent X Z changes it",
                         place, *latitude, extent.x, extent.y);
    else
        diagnostics.warn("{}: a degree is taken as {:.6g} m in both directions; --extent X Z gives "
                         "the tile's true size, as would a name such as N60E010",
                         place, metresOfLatitude);
    return samples;
}

} // namespace sward::terrain
