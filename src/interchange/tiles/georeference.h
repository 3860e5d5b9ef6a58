#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <string>
#include <vector>

namespace sward::interchange {

/// A place on the Earth: longitude and latitude [°] on WGS84, and height above its ellipsoid [m].
struct Geodetic {
    double longitude = 0.0; ///< −180 to 180, to the east
    double latitude = 0.0;  ///< −90 to 90, to the north
    double height = 0.0;
};

/// Where the world of a map lies on the Earth.
struct MapToEarth {
    std::string name; ///< of its coordinate system, in messages
    /// Longitudes and latitudes [°, WGS84] of places [m] to the east and north in the world;
    /// infinite where there are none.
    std::function<std::vector<glm::dvec2>(std::vector<glm::dvec2>)> degreesOf;
    double height = 0.0; ///< [m] of the world's y = 0 above the ellipsoid
};

/// The same as a place of the earth-centred, earth-fixed frame (EPSG:4978) [m]. Exact but for
/// rounding, which is below 1e-8 m.
glm::dvec3 earthCentred(const Geodetic& place);

/// Converts from metres to the east, to the north and upwards of `place` to that frame.
glm::dmat4 eastNorthUp(const Geodetic& place);

} // namespace sward::interchange
