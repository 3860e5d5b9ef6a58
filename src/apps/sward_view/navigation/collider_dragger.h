#pragma once

#include "apps/sward_view/fields/picking.h"
#include "presentation/ground_surface.h"
#include "render/frame/colliders.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sward::view {

/// Drags a collider over the ground by the mouse and throws it.
class ColliderDragger {
public:
    /// The collider edited by the panel; may be beyond the last.
    std::size_t chosen = 0;

    /// Grabs the nearest collider in front of the ground; returns whether there was one.
    bool grab(const std::vector<render::Collider>& colliders, const Sight& sight,
              const presentation::GroundSurface& ground, double time);

    /// Moves the held collider to the ground point on the line of sight.
    void drag(const Sight& sight, const presentation::GroundSurface& ground,
              const std::function<glm::dvec3(const glm::dvec3&)>& upAt);

    /// Releases the collider; a fast one rolls on, and falls where the ground ends.
    void release();

    bool holds() const { return held_.has_value(); }

    /// Moves held, rolling and falling colliders from time `before` to `now` [s].
    void advance(std::vector<render::Collider>& colliders,
                 const presentation::GroundSurface& ground,
                 const std::function<glm::dvec3(const glm::dvec3&)>& upAt, double before,
                 double now);

    /// Stops all motion after the list of colliders has changed.
    void forget();

private:
    struct Rolling {
        std::size_t index;
        glm::dvec3 velocity; ///< [m/s]
        double fallen = 0.0; ///< [s] since it left the ground
    };

    /// Way of a rolling or falling collider in `seconds`; changes its velocity.
    static glm::dvec3 wayOf(Rolling& one, const std::vector<render::Collider>& colliders,
                            const presentation::GroundSurface& ground, const glm::dvec3& up,
                            double before, double seconds);

    std::optional<std::size_t> held_;
    std::optional<glm::dvec3> wanted_; ///< target centre of the held collider, world [m]
    double radius_ = 0.5;              ///< [m] of the held collider
    glm::dvec3 velocity_{0.0};         ///< [m/s] of the held collider
    std::vector<Rolling> rolling_;
};

/// Centre of the collider at `time`, between both ends.
glm::dvec3 middleOf(const render::Collider& collider, double time);

} // namespace sward::view
