#pragma once

#include "presentation/ground_surface.h"
#include "render/frame/camera.h"

#include <optional>

namespace sward::field {
struct FieldView;
} // namespace sward::field

namespace sward::presentation {

/// Cameras that show all of `content` (relative to `origin`), with `groundUp` as up: obliquely from
/// above (fit), standing inside at eye level (eye), straight down (top), along the ground from its
/// border (edge).
enum class CameraPreset { fit, eye, top, edge };
render::Camera presetCamera(CameraPreset preset, const Aabb& content, glm::dvec3 origin,
                            glm::vec3 groundUp, float aspect);

/// What preset cameras depend on beside the field.
struct PresetSettings {
    glm::vec3 groundUp{0.0f, 1.0f, 0.0f};       ///< unit: away from the ground
    float aspect = 16.0f / 9.0f;                ///< width of the picture / height
    std::optional<glm::vec3> sunDirection = {}; ///< towards the sun; unset: as FrameSettings::of()
    const GroundSurface* surface = nullptr;     ///< of the field; null: made as needed
};

/// The preset cameras for a field whose shape is known: they frame its patches and
/// ground instead of its box.
/// `fit` shows the whole from the sunny side, the sun beside or three-quarters behind the camera,
/// where most roots are seen; a heightfield with its horizon. `eye` is findViewpoint() at the
/// height of a person, less on grounds shorter than 8 m. `edge` starts at the actual ground.
render::Camera presetCamera(CameraPreset preset, const field::FieldView& field,
                            const PresetSettings& settings);

/// The same under the usual sun.
render::Camera presetCamera(CameraPreset preset, const field::FieldView& field, glm::vec3 groundUp,
                            float aspect);

} // namespace sward::presentation
