#pragma once

#include "render/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::view {

/// A camera on a sphere around a target, steered by the mouse.
class Orbit {
public:
    /// Starts at `home`; turns around `axis` (unit), which stays upwards in the picture.
    Orbit(const render::Camera& home, glm::vec3 axis);

    /// Turns about the target by a drag of `pixels` in a picture `height` pixels high; dragging
    /// over the whole height turns by half a circle.
    void rotate(glm::vec2 pixels, float height);

    /// Moves target and eye so that points at the target's distance follow the drag.
    void pan(glm::vec2 pixels, float height);

    /// Moves nearer by `steps` of the wheel, a tenth of the distance each; never reaches the
    /// target.
    void dolly(float steps);

    /// Sets another camera, without changing the target of reset().
    void show(const render::Camera& camera);

    void reset() { show(home_); }

    const render::Camera& camera() const { return camera_; }

private:
    render::Camera home_;
    glm::dvec3 axis_;
    render::Camera camera_;
};

} // namespace sward::view
