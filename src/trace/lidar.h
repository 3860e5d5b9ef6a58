#pragma once

#include "core/progress.h"
#include "trace/ray_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace sward::trace {

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

/// What a sensor tells of one place of a beam.
struct LidarReturn {
    static constexpr std::uint32_t ground = 0xffffffffU; ///< see `blade`

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

/// What became of the pulses.
struct LidarCounts {
    std::uint64_t beams = 0;      ///< cast
    std::uint64_t returns = 0;    ///< handed to the sink
    std::uint64_t rays = 0;       ///< cast
    std::uint64_t groundRays = 0; ///< that met the ground
    std::uint64_t freeRays = 0;   ///< that met nothing
};

/// Casts all beams and hands their returns, in the order of beams and of range, to `sink`, piece by
/// piece. A ray ends at the first surface: leaves let nothing through. `species`: of each blade of
/// the field. `origin`: the field's. The result is the same for any number of threads. Advances
/// `progress`, whose stage the caller has begun, by a step for each beam. Throws Error{usage} for
/// settings out of range or a direction that is not unit, Error{interrupted} if it is cancelled.
LidarCounts scan(const RayScene& scene, glm::dvec3 origin, std::span<const std::uint8_t> species,
                 const Beams& beams, const LidarSettings& settings,
                 const std::function<void(std::span<const LidarReturn>)>& sink, Progress& progress);

} // namespace sward::trace
