#pragma once

#include "render/frame_settings.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace sward::render {

/// Where a field stands in the host's world: world = position + scale · rotation · place, with
/// places as the field's file counts them, its origin included.
struct Placement {
    glm::dvec3 position{0.0};                ///< world [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit
    double scale = 1.0;                      ///< > 0, world metres per metre of the field

    /// From the field's places, relative to `origin`, to the world.
    glm::dmat4 toWorld(glm::dvec3 origin) const;

    glm::dvec3 placeInField(glm::dvec3 world) const;       ///< the place of a place
    glm::vec3 directionInField(glm::vec3 direction) const; ///< of the same length
};

/// Settings that count in the world as the field counts: lengths are divided by the scale, places
/// and directions turned. Strengths stay: they are in heights of a blade, whatever its size.
FrameSettings inField(const Placement& placement, FrameSettings world);

} // namespace sward::render
