#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace sward::render {

struct FrameSettings;

/// Placement of a field in the host's world: world = position + scale · rotation · place. Places
/// are in the field file's coordinates, with its origin added.
struct Placement {
    glm::dvec3 position{0.0};                ///< world [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit
    double scale = 1.0;                      ///< > 0, world metres per metre of the field

    /// From the field's places, relative to `origin`, to the world.
    glm::dmat4 toWorld(glm::dvec3 origin) const;

    glm::dvec3 placeInField(glm::dvec3 world) const;       ///< inverse of the placement
    glm::vec3 directionInField(glm::vec3 direction) const; ///< keeps the length
};

/// Converts settings from world space to the field's space: divides lengths by the scale,
/// transforms places and directions. Strengths stay: they are in blade heights.
FrameSettings inField(const Placement& placement, FrameSettings world);

} // namespace sward::render
