#pragma once

#include "shaders/shared/lidar/returns.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace sward::lidar {

/// A pulse of a range sensor.
struct Beam {
    glm::dvec3 from{0.0};    ///< [m] world
    glm::vec3 towards{0.0f}; ///< direction, unit
};

/// The pulses of a sensor. `beam` is called by several threads at once, for numbers below `count`.
struct Beams {
    std::uint64_t count = 0;
    std::function<Beam(std::uint64_t)> beam;
};

/// How a sensor measures.
struct LidarSettings {
    float divergence = 0.0f;      ///< [rad] full angle of the cone, ≥ 0
    float exitWidth = 0.0f;       ///< [m] width of a beam where it starts, ≥ 0
    std::uint32_t rays = 1;       ///< of a beam, spread evenly over its cross-section; 1 to 4096
    std::uint32_t maxReturns = 5; ///< the nearest are kept; 1 to 15
    float resolution = 0.3f;      ///< [m] what lies within it of the nearest makes one return, ≥ 0
    float nearest = 0.0f;         ///< [m] what is nearer gives no return, but hides
    float farthest = std::numeric_limits<float>::infinity(); ///< [m]
    float groundReflectance = 0.25f;                         ///< [0, 1] at the sensor's wavelength
    std::vector<float> leafReflectance{}; ///< [0, 1] likewise, one for each species; not empty
    std::uint64_t seed = 0;               ///< of the turn of each beam's rays
};

/// Throws Error{usage} for settings out of range.
void requireSettings(const LidarSettings& settings);

/// What a sensor tells of one place of a beam.
struct LidarReturn {
    static constexpr std::uint32_t ground = shared::lidarGround; ///< see `blade`

    std::uint64_t beam = 0;
    double range = 0.0;     ///< [m] mean of its rays, by their power
    glm::dvec3 place{0.0};  ///< [m] world: on the beam's axis, at `range`
    float intensity = 0.0f; ///< sum over its rays of reflectance · cos(incidence) / rays: 1 is a
                            ///< white plane across the whole beam
    float incidence = 0.0f; ///< [rad] between ray and normal, where its nearest ray meets `blade`
    std::uint32_t blade = ground; ///< index in the field of what most of its rays meet
    std::uint8_t number = 1;      ///< 1 is the nearest return of the beam
    std::uint8_t returns = 1;     ///< how many the beam has
};

/// Returns in the order of beams and of range, in parts that follow one another.
using ReturnParts = std::vector<std::vector<LidarReturn>>;

/// Takes the next returns of a scan.
using ReturnSink = std::function<void(ReturnParts)>;

/// What became of the pulses.
struct LidarCounts {
    std::uint64_t beams = 0;      ///< cast
    std::uint64_t returns = 0;    ///< handed to the sink
    std::uint64_t rays = 0;       ///< cast
    std::uint64_t groundRays = 0; ///< that met the ground
    std::uint64_t freeRays = 0;   ///< that met nothing
};

/// The settings as rays know them.
shared::LidarSensor sensorOf(const LidarSettings& settings);

/// Reflectances of the surfaces of rays (shared::raySurfaces). `settings` are valid.
std::vector<float> reflectancesOf(const LidarSettings& settings);

/// Places of a beam's rays in its cross-section, a unit disk: Vogel's spiral (1979), which spreads
/// points evenly; a single ray is the axis.
std::vector<glm::vec2> spiralOf(std::uint32_t rays);

/// Beam `number` as its rays know it: relative to the field's origin, and turned at random. Throws
/// Error{usage} for a direction that is not unit.
shared::LidarBeam castBeam(const Beam& beam, std::uint64_t number, glm::dvec3 origin,
                           std::uint64_t seed);

/// Return `place`, from 0, of the `count` returns of a beam.
LidarReturn returnOf(const shared::LidarEcho& echo, const Beam& beam, std::uint64_t number,
                     std::uint32_t place, std::uint32_t count);

} // namespace sward::lidar
