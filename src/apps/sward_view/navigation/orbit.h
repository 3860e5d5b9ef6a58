#pragma once

#include "apps/sward_view/navigation/framing.h"
#include "render/frame/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::view {

/// A camera on a sphere around a pivot, usually its target, steered by the mouse. The pivot stays
/// at its place in the picture.
class Orbit {
public:
    /// Starts at `home`; turns around `axis` (unit), which stays upwards in the picture.
    Orbit(const Framing& home, glm::vec3 axis);
    Orbit(const render::Camera& home, glm::vec3 axis)
        : Orbit(Framing(home), axis)
    {
    }

    /// Turns about the pivot by a drag of `pixels` in a picture `height` pixels high; dragging
    /// over the whole height turns by half a circle.
    void rotate(glm::vec2 pixels, float height);

    /// Moves pivot, target and eye so that points at the target's distance follow the drag.
    void pan(glm::vec2 pixels, float height);

    /// Moves nearer by `steps` of the wheel, a tenth of the distance each; never reaches the
    /// pivot.
    void dolly(float steps);

    /// Sets another camera, without changing the target of reset().
    void show(const Framing& framing) { now_ = framing; }
    void show(const render::Camera& camera) { now_ = Framing(camera); }

    void reset() { show(home_); }

    const render::Camera& camera() const { return now_.camera; }
    const Framing& framing() const { return now_; }

private:
    Framing home_;
    glm::dvec3 axis_;
    Framing now_;
};

} // namespace sward::view
