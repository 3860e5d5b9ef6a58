#pragma once

#include "render/camera.h"

namespace sward::field {
struct FieldView;
} // namespace sward::field

namespace sward::render {

/// The preset cameras of camera.h for a field whose shape is known: they frame its patches and
/// ground instead of its box, and their eye height starts at the actual ground.
Camera presetCamera(CameraPreset preset, const field::FieldView& field, glm::vec3 groundUp,
                    float aspect);

} // namespace sward::render
