#pragma once

#include "apps/sward_view/scene/camera_path.h"
#include "field/field.h"
#include "render/frame/camera.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <string>

namespace sward {
class SettingsReader;
} // namespace sward

namespace sward::view {

/// Reads {"eye": [x,y,z], "target": [x,y,z], "up": [x,y,z], "fov_y_deg": 45}; `up` and `fov_y_deg`
/// are optional. Messages name `place`. Throws Error{input} naming the key if the view direction is
/// zero or parallel to up.
render::Camera readCamera(SettingsReader& reader, const std::string& place, glm::vec3 up);

/// The same from a file. Throws Error{io} if it cannot be read.
render::Camera readCamera(const std::filesystem::path& path, glm::vec3 up);

/// The camera of --camera: fit, eye, top, edge, or a file with a camera or a path.
CameraPath chooseCamera(const std::string& name, const field::FieldView& field, float aspect,
                        glm::vec3 sunDirection);

/// Unit vector away from the field's gravity: the up-vector of its cameras.
glm::vec3 groundUpOf(const field::FieldView& field);

} // namespace sward::view
