#pragma once

#include "apps/sward_view/interface/covered.h"
#include "field/field.h"
#include "render/frame/camera.h"

#include <glm/vec2.hpp>
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

/// Width of a window over its height, and the shares of its width and height that the interface
/// covers, [0, 0.9] together.
struct Pane {
    float aspect = 16.0f / 9.0f;
    float left = 0.0f;
    float right = 0.0f;
    float bottom = 0.0f;

    bool isWhole() const { return left <= 0.0f && right <= 0.0f && bottom <= 0.0f; }
    /// Width of the free part over its height.
    float freeAspect() const { return aspect * (1.0f - left - right) / (1.0f - bottom); }
    /// Middle of the free part to the right of the window's middle, in shares of the width.
    float shift() const { return 0.5f * (left - right); }
};

/// The part of a window of `size` in which `fit` shows a field: what is beside the panel. Rail and
/// status bar alone do not move it aside; they only make it smaller where they are wider than its
/// margin.
Pane paneOf(glm::vec2 size, const Covered& covered);

/// The camera that looks as `fit` does, with all of the field in the free part of the window. `fit`
/// is a camera for a picture of the free part.
Framing framedBeside(const render::Camera& fit, const Pane& pane, const field::FieldView& field);

} // namespace sward::view
