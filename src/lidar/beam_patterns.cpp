#include "lidar/beam_patterns.h"

#include "core/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::lidar {
namespace {

constexpr double maxGridBeams = 0x1.0p40;

// Two unit axes across `up`; +X and −Z if that is +Y, so that a turn from the first to the second
// is counter-clockwise from above.
struct Level {
    glm::dvec3 first, second;

    explicit Level(glm::dvec3 up)
    {
        const glm::dvec3 aside = std::abs(up.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
        first = glm::normalize(glm::cross(aside, up));
        second = glm::cross(up, first);
    }
};

} // namespace

Beams beamsOf(const SpinningScanner& scanner)
{
    const auto at = [scanner, level = Level(glm::dvec3(scanner.up))](std::uint64_t number) {
        const double ring = double(number % scanner.rings);
        const double column = double(number / scanner.rings);
        const double share = scanner.rings > 1 ? ring / double(scanner.rings - 1) : 0.5;
        const double elevation =
            scanner.elevation.x + share * double(scanner.elevation.y - scanner.elevation.x);
        const double azimuth =
            scanner.azimuth.x +
            column / double(scanner.columns) * double(scanner.azimuth.y - scanner.azimuth.x);
        const glm::dvec3 along = std::cos(azimuth) * level.first + std::sin(azimuth) * level.second;
        return Beam{scanner.place,
                    glm::vec3(glm::normalize(std::cos(elevation) * along +
                                             std::sin(elevation) * glm::dvec3(scanner.up)))};
    };
    return {std::uint64_t(scanner.rings) * scanner.columns, at};
}

Beams beamsOf(const AirborneScanner& scanner)
{
    const glm::dvec3 up(scanner.up);
    const Level level(up);
    // The box in the axes of the grid.
    glm::dvec3 low(1e300), high(-1e300);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place((corner & 1) != 0 ? scanner.over.high.x : scanner.over.low.x,
                               (corner & 2) != 0 ? scanner.over.high.y : scanner.over.low.y,
                               (corner & 4) != 0 ? scanner.over.high.z : scanner.over.low.z);
        const glm::dvec3 turned(glm::dot(place, level.first), glm::dot(place, level.second),
                                glm::dot(place, up));
        low = glm::min(low, turned);
        high = glm::max(high, turned);
    }
    const glm::dvec3 towards =
        std::sin(double(scanner.tilt)) * level.first - std::cos(double(scanner.tilt)) * up;
    const double top = high.z + scanner.height;
    // Beams that start this far back meet the middle of the box where the grid says.
    const double back = std::tan(double(scanner.tilt)) * (top - 0.5 * (low.z + high.z));
    const double columns = std::floor((high.x - low.x) / scanner.spacing) + 1.0;
    const double rows = std::floor((high.y - low.y) / scanner.spacing) + 1.0;
    if (!(columns * rows <= maxGridBeams))
        fail(ErrorKind::usage,
             "a grid of {:.0f} by {:.0f} beams, {} m apart; the largest has {:.0f}", columns, rows,
             scanner.spacing, maxGridBeams);
    // Lines of flight, each over a strip of rows.
    const double middle = 0.5 * (low.z + high.z);
    const double width = std::max(high.y - low.y, scanner.spacing);
    const double reach = 2.0 * std::tan(double(scanner.sweep)) * (top - middle);
    const double lines = scanner.sweep > 0.0f ? std::ceil(width / reach) : 1.0;
    const auto at = [=](std::uint64_t number) {
        const double column = std::fmod(double(number), columns);
        const double row = std::floor(double(number) / columns);
        if (scanner.sweep > 0.0f) {
            const double off = row * scanner.spacing;
            const double line = std::min(std::floor(off * lines / width), lines - 1.0);
            const double flown = (line + 0.5) * width / lines;
            const glm::dvec3 from = scanner.origin +
                                    (low.x + column * scanner.spacing) * level.first +
                                    (low.y + flown) * level.second + top * up;
            const glm::dvec3 beam = (off - flown) * level.second - (top - middle) * up;
            return Beam{from, glm::vec3(glm::normalize(beam))};
        }
        const glm::dvec3 place = scanner.origin +
                                 (low.x + column * scanner.spacing - back) * level.first +
                                 (low.y + row * scanner.spacing) * level.second + top * up;
        return Beam{place, glm::vec3(towards)};
    };
    return {static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows), at};
}

} // namespace sward::lidar
