#include "interchange/tiles/georeference.h"

#include <glm/trigonometric.hpp>

#include <cmath>

namespace sward::interchange {
namespace {

// WGS84: semi-major axis [m] and flattening.
constexpr double earthRadius = 6378137.0;
constexpr double earthFlattening = 1.0 / 298.257223563;
constexpr double eccentricitySquared = earthFlattening * (2.0 - earthFlattening);

} // namespace

glm::dvec3 earthCentred(const Geodetic& place)
{
    const double longitude = glm::radians(place.longitude);
    const double latitude = glm::radians(place.latitude);
    const double sine = std::sin(latitude);
    const double cosine = std::cos(latitude);
    // The radius of curvature in the prime vertical.
    const double normal = earthRadius / std::sqrt(1.0 - eccentricitySquared * sine * sine);
    return {(normal + place.height) * cosine * std::cos(longitude),
            (normal + place.height) * cosine * std::sin(longitude),
            (normal * (1.0 - eccentricitySquared) + place.height) * sine};
}

glm::dmat4 eastNorthUp(const Geodetic& place)
{
    const double longitude = glm::radians(place.longitude);
    const double latitude = glm::radians(place.latitude);
    const glm::dvec3 east(-std::sin(longitude), std::cos(longitude), 0.0);
    const glm::dvec3 north(-std::sin(latitude) * std::cos(longitude),
                           -std::sin(latitude) * std::sin(longitude), std::cos(latitude));
    const glm::dvec3 up(std::cos(latitude) * std::cos(longitude),
                        std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    return {glm::dvec4(east, 0.0), glm::dvec4(north, 0.0), glm::dvec4(up, 0.0),
            glm::dvec4(earthCentred(place), 1.0)};
}

} // namespace sward::interchange
