#pragma once

#include "shaders/shared/collision.h"

#include <glm/vec3.hpp>

#include <vector>

namespace sward::render {

/// Something that pushes blades aside: a capsule, or a sphere where both ends are one. All places
/// are in world space.
struct Collider {
    glm::dvec3 from{0.0}; ///< [m]
    glm::dvec3 to{0.0};   ///< [m]
    double radius = 0.5;  ///< [m]

    /// By how much it has moved at a time.
    struct Waypoint {
        double time = 0.0;    ///< [s]
        glm::dvec3 move{0.0}; ///< [m]
    };
    std::vector<Waypoint> path; ///< ascending times; before the first and after the last it rests
};

/// By how much it has moved at `time` [s]: straight from waypoint to waypoint.
glm::dvec3 moveAt(const Collider& collider, double time);

/// As the shaders read it at `time` [s], relative to `origin`; its velocity is that of its way
/// since `before`, none if that is not earlier.
shared::Collider colliderAt(const Collider& collider, glm::dvec3 origin, double time,
                            double before);

} // namespace sward::render
