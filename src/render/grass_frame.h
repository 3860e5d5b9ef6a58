#pragma once

#include "render/frame/frame_settings.h"
#include "render/host/host_light.h"
#include "render/host/host_view.h"

#include <glm/vec3.hpp>

#include <span>

namespace sward::render {

class ResidentField;

/// A capsule that pushes blades aside, or a ball if both ends coincide. World space.
struct HostCollider {
    glm::dvec3 from{0.0};     ///< [m]
    glm::dvec3 to{0.0};       ///< [m]
    double radius = 0.5;      ///< [m]
    glm::vec3 velocity{0.0f}; ///< [m/s] of its movement to here
};

/// Description of one frame by the host.
struct GrassFrame {
    /// [s] at most longestTime, 2³³, in magnitude: a clock of any origin. Steps of any length.
    /// Blades move on from frame to frame; if time falls, or steps by more than longestTimeStep
    /// (2.3 hours), they settle in the wind of the new time, as in the first frame.
    double time = 0.0;
    std::span<const HostView> views{}; ///< blades are moved for these and drawn in these

    /// Wind, gravity, sun, sky and level of detail, all in world space. Its colliders are ignored,
    /// and there is no fog if `fogDensity` is below 0.
    const FrameSettings& settings;
    std::span<const HostCollider> colliders{}; ///< at most maxColliders
    HostLight light{};                         ///< the host's ambient light and lamps on blades
};

/// Instances that frames may have, for Grass::prepare().
struct PreparedFields {
    std::span<const ResidentField* const> fields{}; ///< of which there are instances; at least one
    bool one = true;                                ///< frames of a single instance
    bool several = true;                            ///< frames of two and more
};

} // namespace sward::render
