#include "lidar/lidar.h"

#include "core/error.h"
#include "core/random.h"
#include "shaders/shared/lidar/ray_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::lidar {
namespace {

constexpr std::uint32_t maxRays = 4096, maxReturnsOfBeam = 15;

} // namespace

void requireSettings(const LidarSettings& settings)
{
    const auto inRange = [](float value, float low, float high) {
        return value >= low && value <= high;
    };
    requireUsage(inRange(settings.divergence, 0.0f, 1.0f),
                 "LidarSettings::divergence is {} rad; allowed is 0 to 1", settings.divergence);
    requireUsage(inRange(settings.exitWidth, 0.0f, 10.0f),
                 "LidarSettings::exitWidth is {} m; allowed is 0 to 10", settings.exitWidth);
    requireUsage(settings.rays >= 1 && settings.rays <= maxRays,
                 "LidarSettings::rays is {}; allowed is 1 to {}", settings.rays, maxRays);
    requireUsage(settings.maxReturns >= 1 && settings.maxReturns <= maxReturnsOfBeam,
                 "LidarSettings::maxReturns is {}; allowed is 1 to {}", settings.maxReturns,
                 maxReturnsOfBeam);
    requireUsage(settings.resolution >= 0.0f,
                 "LidarSettings::resolution is {} m; it must not be negative", settings.resolution);
    requireUsage(settings.nearest >= 0.0f && settings.farthest > settings.nearest,
                 "LidarSettings: ranges {} to {} m hold nothing", settings.nearest,
                 settings.farthest);
    requireUsage(inRange(settings.groundReflectance, 0.0f, 1.0f),
                 "LidarSettings::groundReflectance is {}; allowed is 0 to 1",
                 settings.groundReflectance);
    requireUsage(!settings.leafReflectance.empty(), "LidarSettings::leafReflectance is empty");
    for (const float one : settings.leafReflectance)
        requireUsage(inRange(one, 0.0f, 1.0f),
                     "LidarSettings::leafReflectance has {}; allowed is 0 to 1", one);
}

shared::LidarSensor sensorOf(const LidarSettings& settings)
{
    shared::LidarSensor sensor = {};
    sensor.halfExit = 0.5f * settings.exitWidth;
    sensor.spread = std::tan(0.5f * settings.divergence);
    sensor.resolution = settings.resolution;
    sensor.nearest = settings.nearest;
    sensor.farthest = settings.farthest;
    sensor.rays = settings.rays;
    sensor.maxReturns = settings.maxReturns;
    return sensor;
}

std::vector<float> reflectancesOf(const LidarSettings& settings)
{
    std::vector<float> all(shared::raySurfaces);
    for (std::size_t slot = 0; slot < shared::rayGroundSurface; ++slot)
        all[slot] = settings.leafReflectance[std::min(slot, settings.leafReflectance.size() - 1)];
    all[shared::rayGroundSurface] = settings.groundReflectance;
    return all;
}

std::vector<glm::vec2> spiralOf(std::uint32_t rays)
{
    std::vector<glm::vec2> places(rays, glm::vec2(0.0f));
    if (rays == 1)
        return places;
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
        const double radius = std::sqrt((double(ray) + 0.5) / double(rays));
        const double angle =
            2.0 * std::numbers::pi * (double(ray) / (std::numbers::phi * std::numbers::phi));
        places[ray] = glm::vec2(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return places;
}

shared::LidarBeam castBeam(const Beam& beam, std::uint64_t number, glm::dvec3 origin,
                           std::uint64_t seed)
{
    requireUsage(std::abs(glm::length(beam.towards) - 1.0f) < 1e-3f,
                 "beam {}: its direction has the length {}", number, glm::length(beam.towards));
    const double turn = 2.0 * std::numbers::pi * uniform(seed, number, 0);
    shared::LidarBeam made = {};
    made.from = glm::vec3(beam.from - origin);
    made.turnCosine = static_cast<float>(std::cos(turn));
    made.towards = glm::normalize(beam.towards);
    made.turnSine = static_cast<float>(std::sin(turn));
    return made;
}

LidarReturn returnOf(const shared::LidarEcho& echo, const Beam& beam, std::uint64_t number,
                     std::uint32_t place, std::uint32_t count)
{
    LidarReturn made;
    made.beam = number;
    made.range = echo.range;
    made.place = beam.from + made.range * glm::dvec3(beam.towards);
    made.intensity = echo.intensity;
    made.incidence = std::acos(std::clamp(echo.cosine, 0.0f, 1.0f));
    made.blade = echo.blade;
    made.number = static_cast<std::uint8_t>(place + 1);
    made.returns = static_cast<std::uint8_t>(count);
    return made;
}

} // namespace sward::lidar
