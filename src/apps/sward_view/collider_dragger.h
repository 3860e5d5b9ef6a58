#pragma once

#include "apps/sward_view/ground_surface.h"
#include "apps/sward_view/picking.h"
#include "render/colliders.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sward::view {

/// The hand that takes a collider by the mouse, drags it over the ground and throws it.
class ColliderDragger {
public:
    /// Which collider the panel turns; may be beyond the last.
    std::size_t chosen = 0;

    /// Takes the nearest collider that the sight meets before the ground; whether there was one.
    bool grab(const std::vector<render::Collider>& colliders, const Sight& sight,
              const GroundSurface& ground, double time);

    /// Where the collider that is held shall lie: on the ground that the sight meets.
    void drag(const Sight& sight, const GroundSurface& ground,
              const std::function<glm::dvec3(const glm::dvec3&)>& upAt);

    /// Lets go; what was quick rolls on.
    void release();

    bool holds() const { return held_.has_value(); }

    /// Moves what is held and what rolls from time `before` to `now` [s].
    void advance(std::vector<render::Collider>& colliders, const GroundSurface& ground,
                 const std::function<glm::dvec3(const glm::dvec3&)>& upAt, double before,
                 double now);

    /// Forgets all that moves: the colliders are others.
    void forget();

private:
    struct Rolling {
        std::size_t index;
        glm::dvec3 velocity; ///< [m/s]
    };

    std::optional<std::size_t> held_;
    std::optional<glm::dvec3> wanted_; ///< of the middle of what is held, world [m]
    double radius_ = 0.5;              ///< [m] of what is held
    glm::dvec3 velocity_{0.0};         ///< [m/s] of what is held
    std::vector<Rolling> rolling_;
};

/// Between both ends, where it is at `time`.
glm::dvec3 middleOf(const render::Collider& collider, double time);

} // namespace sward::view
