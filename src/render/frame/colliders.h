#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace sward::shared {
struct Collider;
} // namespace sward::shared

namespace sward::render {

/// Largest number of colliders of a frame.
inline constexpr std::size_t maxColliders = 256;

/// An object that pushes blades aside: a capsule, or a sphere if both ends coincide. World space.
struct Collider {
    glm::dvec3 from{0.0}; ///< [m]
    glm::dvec3 to{0.0};   ///< [m]
    double radius = 0.5;  ///< [m]

    /// Displacement at a time.
    struct Waypoint {
        double time = 0.0;    ///< [s]
        glm::dvec3 move{0.0}; ///< [m]
    };
    std::vector<Waypoint> path; ///< ascending times; at rest before the first and after the last
};

/// Displacement at `time` [s], linear between waypoints.
glm::dvec3 moveAt(const Collider& collider, double time);

/// The collider for shaders at `time` [s], relative to `origin`. Its velocity is the mean since
/// `before`, or zero unless `before` < `time`.
shared::Collider colliderAt(const Collider& collider, glm::dvec3 origin, double time,
                            double before);

/// The same for all of a frame's colliders.
std::vector<shared::Collider> collidersAt(std::span<const Collider> colliders, glm::dvec3 origin,
                                          double time, double before);

} // namespace sward::render
