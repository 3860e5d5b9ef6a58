#pragma once

#include "field/field.h"
#include "render/camera.h"

#include <glm/vec3.hpp>

namespace sward::view {

/// A camera, and the point that orbits go around: beside the picture's middle if a panel covers a
/// part of the window.
struct Framing {
    /// Orbits go around the camera's target.
    explicit Framing(const render::Camera& all)
        : camera(all)
        , pivot(all.target)
    {
    }
    Framing(const render::Camera& all, const glm::dvec3& around)
        : camera(all)
        , pivot(around)
    {
    }

    render::Camera camera;
    glm::dvec3 pivot; ///< world [m]
};

/// Width of a window over its height, and the share of its width that a panel covers on the left,
/// [0, 0.9].
struct Pane {
    float aspect = 16.0f / 9.0f;
    float covered = 0.0f;
};

/// Moves `fit`, which shows the whole field in the window, aside and back, so that the field lies
/// in the free part of the window.
Framing framedBeside(const render::Camera& fit, const Pane& pane, const field::FieldView& field);

} // namespace sward::view
