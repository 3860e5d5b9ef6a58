#pragma once

#include "render/frame_settings.h"

#include <glm/vec3.hpp>

namespace sward {
class SettingsReader;
} // namespace sward

namespace sward::render {

/// Reads the key "look" of a settings file: sun, sky, air and film; what is absent stays as it is.
/// docs/settings.md. Throws Error{input}.
void readLook(SettingsReader& reader, FrameSettings& settings);

/// Unit vector towards a sun `azimuth` degrees clockwise from north (−z) and `elevation` degrees
/// above the level.
glm::vec3 sunTowards(double azimuth, double elevation);

/// Where the sun stands in such angles.
struct SunPlace {
    double azimuth = 0.0;   ///< [degrees] in (−180, 180]
    double elevation = 0.0; ///< [degrees]
};
SunPlace sunPlaceOf(glm::vec3 direction);

/// Linear radiance of sunlight that has come through the air at this `elevation` [degrees]: that of
/// FrameSettings at its own, redder and weaker the lower the sun stands. Air mass: Kasten & Young
/// 1989; extinction of clear air with a little haze.
glm::vec3 sunColorAt(double elevation);

} // namespace sward::render
