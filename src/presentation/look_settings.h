#pragma once

#include "render/frame/frame_settings.h"

#include <glm/vec3.hpp>

namespace sward {
class SettingsReader;
} // namespace sward

namespace sward::presentation {

/// Reads the key "look" of a settings file: sun, sky, air and film. Absent keys keep their values.
/// docs/settings.md. Throws Error{input}.
void readLook(SettingsReader& reader, render::FrameSettings& settings);

/// Unit vector towards a sun at `azimuth` degrees clockwise from north (−z) and `elevation` degrees
/// above the horizon.
glm::vec3 sunTowards(double azimuth, double elevation);

/// Position of the sun in these angles.
struct SunPlace {
    double azimuth = 0.0;   ///< [degrees] in (−180, 180]
    double elevation = 0.0; ///< [degrees]
};
SunPlace sunPlaceOf(glm::vec3 direction);

/// Linear radiance of sunlight at this `elevation` [degrees]. It equals FrameSettings::sunColor at
/// the default elevation; a lower sun is redder and weaker. Air mass: Kasten & Young 1989;
/// extinction of clear air with a little haze.
glm::vec3 sunColorAt(double elevation);

/// Linear radiance of the sky at this `elevation` of the sun [degrees]. It equals
/// FrameSettings::skyColor from the default elevation upwards; a lower sun's sky is darker and less
/// blue, by what clear air scatters out of the beam. It never gets wholly dark.
glm::vec3 skyColorAt(double elevation);

/// Linear radiance of grass in that light: FrameSettings::groundColor from the default elevation
/// upwards. A low sun lights standing leaves, too, so grass gets redder rather than dark.
glm::vec3 groundColorAt(double elevation);

/// Factor of a chosen exposure with the sun at this `elevation` [degrees], 1 to 2: half of the
/// stops by which grass is darker than in the usual light. 1 from the default elevation upwards.
float adaptationAt(double elevation);

/// Sets the colours of sun, sky and ground, and the adaptation, by the sun's direction: all these,
/// and no sunlight from below the horizon.
void setLightByElevation(render::FrameSettings& settings);

} // namespace sward::presentation
