#include "apps/sward_view/scene/time_of_day.h"

#include "render/frame/frame_settings.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr double latitude = 50.0;    ///< [degrees]
constexpr double declination = 18.0; ///< [degrees] of the sun, in May and July

} // namespace

presentation::SunPlace sunAt(double hour)
{
    const double turn = glm::radians(15.0 * (hour - 12.0));
    const double north = glm::radians(latitude);
    const double tilt = glm::radians(declination);
    const double rise =
        std::sin(north) * std::sin(tilt) + std::cos(north) * std::cos(tilt) * std::cos(turn);
    const double azimuth = std::atan2(std::sin(turn), std::cos(turn) * std::sin(north) -
                                                          std::tan(tilt) * std::cos(north));
    return {std::remainder(glm::degrees(azimuth) + 180.0, 360.0),
            glm::degrees(std::asin(std::clamp(rise, -1.0, 1.0)))};
}

double hourOf(double elevation, double near)
{
    // The inverse of sunAt(): the same elevation before and after noon.
    const double north = glm::radians(latitude);
    const double tilt = glm::radians(declination);
    const double turn = (std::sin(glm::radians(elevation)) - std::sin(north) * std::sin(tilt)) /
                        (std::cos(north) * std::cos(tilt));
    const double fromNoon = glm::degrees(std::acos(std::clamp(turn, -1.0, 1.0))) / 15.0;
    return near < 12.0 ? 12.0 - fromNoon : 12.0 + fromNoon;
}

void setTimeOfDay(render::FrameSettings& settings, double before, double hour)
{
    const presentation::SunPlace sun = presentation::sunPlaceOf(settings.sunDirection);
    const presentation::SunPlace now = sunAt(hour);
    settings.sunDirection =
        presentation::sunTowards(sun.azimuth + now.azimuth - sunAt(before).azimuth, now.elevation);
    presentation::setLightByElevation(settings);
}

} // namespace sward::view
