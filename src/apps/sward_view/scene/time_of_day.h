#pragma once

#include "presentation/look_settings.h"

#include <glm/vec3.hpp>

namespace sward::render {
struct FrameSettings;
} // namespace sward::render

namespace sward::view {

/// Place of the sun at an `hour` [h] of local solar time, 0 to 24, on a day in summer at 50° north.
presentation::SunPlace sunAt(double hour);

/// The hour nearest to `near` at which the sun is as high as `elevation` [degrees], or nearest to
/// it.
double hourOf(double elevation, double near);

/// Moves the sun from one hour to another: its elevation, and its azimuth by as much as it turns
/// meanwhile. Sets the light of sun, sky and ground by the elevation.
void setTimeOfDay(render::FrameSettings& settings, double before, double hour);

} // namespace sward::view
