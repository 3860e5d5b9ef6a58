#pragma once

#include "apps/sward_view/fields/picking.h"
#include "presentation/ground_surface.h"
#include "render/frame/colliders.h"

#include <functional>
#include <vector>

namespace sward::view {

/// Where a new collider may lie.
struct NewCollider {
    const presentation::GroundSurface& ground;
    std::function<glm::dvec3(const glm::dvec3&)> upAt; ///< unit, world
    double fieldSize = 10.0;                           ///< [m]
    double time = 0.0;                                 ///< [s] of the places of the others
};

/// A ball or capsule on the ground along the line of sight, beside `others`. Without ground there,
/// before the camera.
render::Collider newCollider(const NewCollider& where, const Sight& sight, bool isCapsule,
                             const std::vector<render::Collider>& others);

} // namespace sward::view
