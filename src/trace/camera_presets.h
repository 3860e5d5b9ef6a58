#pragma once

#include "field/field.h"
#include "trace/camera.h"
#include "trace/ray_scene.h"

#include <glm/vec3.hpp>

namespace sward::trace {

/// Views of a field.
enum class CameraPreset {
    fit, ///< all of it, from above and from the side of the sun
    eye, ///< from the height of a person, along its longer side from near an end
    top, ///< all of it, straight down
};

/// The camera of a preset. The viewer's presets of these names look for a better place, and are not
/// the same. `up`: unit, away from the ground. `sun`: towards the sun. `aspect`: width of the
/// picture / height. `scene` has the field's ground.
Camera presetCamera(CameraPreset preset, const field::FieldView& field, const RayScene& scene,
                    glm::vec3 up, glm::vec3 sun, double aspect);

} // namespace sward::trace
