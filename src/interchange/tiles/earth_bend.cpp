#include "interchange/tiles/earth_bend.h"

#include "core/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::interchange {
namespace {

// Least distance of knots [m], and most of them along an axis.
constexpr double minStep = 512.0;
constexpr double maxSteps = 1000.0;

// Weights of the four knots around a place, of which it lies between the second and the third: the
// curve of Catmull and Rom, exact for parabolas.
std::array<double, 4> cubicWeights(double t)
{
    const double t2 = t * t;
    const double t3 = t2 * t;
    return {0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
            0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)};
}

// The normal of the ellipsoid at a longitude and latitude.
glm::dvec3 upAt(const Geodetic& place)
{
    return glm::dvec3(eastNorthUp(place)[2]);
}

} // namespace

EarthBend::EarthBend(const MapToEarth& map, const glm::dvec3& origin, const DAabb& roots)
{
    const glm::dvec3 low = roots.isEmpty() ? glm::dvec3(0.0) : roots.low;
    const glm::dvec3 extent = roots.size();
    const glm::dvec3 middle = low + 0.5 * extent;
    step_ = std::max(minStep, std::max(extent.x, extent.z) / maxSteps);
    lowX_ = low.x - 1.5 * step_;
    lowZ_ = low.z - 1.5 * step_;
    columns_ = static_cast<std::size_t>(std::ceil(extent.x / step_)) + 4;
    rows_ = static_cast<std::size_t>(std::ceil(extent.z / step_)) + 4;

    // The knots, and at last the middle and a place north of it.
    std::vector<glm::dvec2> places;
    places.reserve(columns_ * rows_ + 2);
    const auto add = [&](double x, double z) {
        places.emplace_back(origin.x + x, -(origin.z + z));
    };
    for (std::size_t row = 0; row < rows_; ++row)
        for (std::size_t column = 0; column < columns_; ++column)
            add(lowX_ + double(column) * step_, lowZ_ + double(row) * step_);
    add(middle.x, middle.z);
    add(middle.x, middle.z - 1.0);
    const std::vector<glm::dvec2> degrees = map.degreesOf(places);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!std::isfinite(degrees[i].x) || !std::isfinite(degrees[i].y))
            fail(ErrorKind::input,
                 "the place {:.0f} m east, {:.0f} m north is nowhere on the Earth in {}",
                 places[i].x, places[i].y, map.name);
    const double height = origin.y + map.height;
    const auto geodetic = [&](std::size_t i, double above) {
        return Geodetic{
            .longitude = degrees[i].x, .latitude = degrees[i].y, .height = height + above};
    };

    // The bent field touches the flat one in its middle: up is up there, and north is the map's.
    const std::size_t knotCount = columns_ * rows_;
    const glm::dvec3 centre = earthCentred(geodetic(knotCount, middle.y));
    const glm::dvec3 up = upAt(geodetic(knotCount, 0.0));
    const glm::dvec3 along = earthCentred(geodetic(knotCount + 1, middle.y)) - centre;
    const glm::dvec3 north = glm::normalize(along - up * glm::dot(along, up));
    const glm::dmat3 axes(glm::cross(north, up), up, -north);

    knots_.resize(knotCount);
    for (std::size_t i = 0; i < knotCount; ++i) {
        knots_[i].ground = (earthCentred(geodetic(i, 0.0)) - centre) * axes + middle;
        knots_[i].up = upAt(geodetic(i, 0.0)) * axes;
    }
    turnKnots();
    toEarth_ = glm::dmat4(axes);
    toEarth_[3] = glm::dvec4(centre - axes * middle, 1.0);
}

// Sets the turns of all knots that are not on the edge, and the curvature.
void EarthBend::turnKnots()
{
    double across = 0.0;
    double twist = 0.0;
    for (std::size_t row = 1; row + 1 < rows_; ++row)
        for (std::size_t column = 1; column + 1 < columns_; ++column) {
            const std::size_t i = row * columns_ + column;
            Knot& own = knots_[i];
            const glm::dvec3& west = knots_[i - 1].ground;
            const glm::dvec3& east = knots_[i + 1].ground;
            const glm::dvec3& north = knots_[i - columns_].ground;
            const glm::dvec3& south = knots_[i + columns_].ground;
            across = std::max({across, glm::length(west + east - 2.0 * own.ground),
                               glm::length(north + south - 2.0 * own.ground)});
            twist = std::max(
                twist, glm::length(own.ground + knots_[i + columns_ + 1].ground - east - south));
            const glm::dvec3 along = south - north;
            const glm::dvec3 z = glm::normalize(along - own.up * glm::dot(along, own.up));
            const glm::dquat turn = glm::quat_cast(glm::dmat3(glm::cross(own.up, z), own.up, z));
            own.turn = glm::dvec3(turn.x, turn.y, turn.z) * (turn.w < 0.0 ? -1.0 : 1.0);
        }
    curvature_ = (across + twist) / (step_ * step_);
}

EarthBend::Cell EarthBend::cellOf(const glm::dvec3& place) const
{
    // There is a knot more on each side of a cell.
    const double x = (place.x - lowX_) / step_;
    const double z = (place.z - lowZ_) / step_;
    const double column = std::clamp(std::floor(x), 1.0, double(columns_ - 3));
    const double row = std::clamp(std::floor(z), 1.0, double(rows_ - 3));
    return {.first = static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column),
            .x = x - column,
            .z = z - row};
}

glm::dvec3 EarthBend::moved(const glm::dvec3& place) const
{
    const Cell cell = cellOf(place);
    const std::array<double, 4> alongX = cubicWeights(cell.x);
    const std::array<double, 4> alongZ = cubicWeights(cell.z);
    glm::dvec3 sum(0.0);
    const Knot* row = &knots_[cell.first - columns_ - 1];
    for (std::size_t z = 0; z < 4; ++z, row += columns_)
        for (std::size_t x = 0; x < 4; ++x)
            sum += alongX[x] * alongZ[z] * (row[x].ground + place.y * row[x].up);
    return sum;
}

DAabb EarthBend::moved(const DAabb& box) const
{
    DAabb bent;
    for (int corner = 0; corner < 8; ++corner)
        bent.add(moved({(corner & 1) != 0 ? box.high.x : box.low.x,
                        (corner & 2) != 0 ? box.high.y : box.low.y,
                        (corner & 4) != 0 ? box.high.z : box.low.z}));
    // Between the corners it departs from a bilinear sheet by at most an eighth of the second
    // derivative times the square of the width along each axis. Twice that, since knots show the
    // derivative in steps.
    const glm::dvec3 size = box.size();
    const double margin = 1e-6 + 0.25 * curvature_ * (size.x * size.x + size.z * size.z);
    bent.low -= margin;
    bent.high += margin;
    return bent;
}

glm::dquat EarthBend::turn(const glm::dvec3& place) const
{
    const Cell cell = cellOf(place);
    const Knot* const knot = &knots_[cell.first];
    const glm::dvec3 vector =
        glm::mix(glm::mix(knot[0].turn, knot[1].turn, cell.x),
                 glm::mix(knot[columns_].turn, knot[columns_ + 1].turn, cell.x), cell.z);
    return {std::sqrt(std::max(0.0, 1.0 - glm::dot(vector, vector))), vector.x, vector.y, vector.z};
}

} // namespace sward::interchange
